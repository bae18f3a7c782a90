#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ccdt {

/// What the texts of a mesher's description may leave to the run, written in braces: "{input}". A name is of small
/// letters and underscores; anything else in braces stays as it is, so that scripts may have braces of their own.
///
/// | name          | stands for                                                                                 |
/// |---------------|--------------------------------------------------------------------------------------------|
/// | `input`       | the file with the input; the program runs in the folder where it is                        |
/// | `stem`        | its name without the ending                                                                |
/// | `folder`      | that folder, which is of this run alone                                                    |
/// | `here`        | the folder of the description                                                              |
/// | `edge_length` | how long edges are to be, in the units of the input                                        |
/// | `max_volume`  | largest tetrahedron of a mesh of such edges: twice the volume of the regular one, which is |
/// |               | about the average                                                                          |
///
/// and the description's own `choices`.
struct Placeholder {
  std::string name, value;
};

/// The names of those above.
const std::vector<std::string>& placeholder_names();

/// The names in a text, in its order.
std::vector<std::string> placeholders_in(std::string_view text);

/// The text with the values; what is not among them stays.
std::string filled(std::string_view text, const std::vector<Placeholder>& values);

}  // namespace ccdt
