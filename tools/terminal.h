#pragma once

#include <string>
#include <string_view>

namespace ccdt::tools {

enum class Tone { good, bad, note };

/// Makes a text safe for a terminal. Texts may contain names and contents of files, whose control characters could take
/// over a terminal. All control characters except line feeds and tabs, and those that turn the direction of text, are
/// escaped as in JSON: "\u001b". Bytes that are not UTF-8 are written as "\x9b".
std::string printable(std::string_view text);

/// Where words for people go.
enum class Words {
  to_output,  ///< standard output
  to_error,   ///< standard error, because standard output gets data
  on_failure  ///< nowhere, or to standard error if the program fails
};

/// Chooses it for everything that `print` gets from now on.
void send_words(Words where);

/// Is nobody interested in words, nor in progress?
bool is_quiet();

/// Prints words for people, `printable`. On a terminal, its lines are `wrapped`.
void print(std::string_view text);

/// The same in color on a terminal. `NO_COLOR` (no-color.org) and `TERM=dumb` switch colors off.
void print(std::string_view text, Tone tone);

/// Writes a text that programs read to standard output as it is. \throw OutputError  it cannot be written
void print_data(std::string_view text);

/// Prints the help of a verb, `wrapped` for the terminal.
void print_help(const std::string& help);

/// Prints a line to standard error, `printable`, and on a terminal `wrapped`.
void print_error_line(std::string_view text);

/// The end of all printing.
/// \param failed      then words that were kept for a failure are printed
/// \throw OutputError  something that was printed could not be written
void finish_output(bool failed);

}  // namespace ccdt::tools
