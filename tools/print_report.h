#pragma once

#include <filesystem>

#include "reports/write_report.h"

namespace ccdt {

/// Makes the report of a folder from its JSON, and prints its verdicts and where it is.
/// \throw InputError, OutputError  as `read_report` and `write_report`
void make_report(const std::filesystem::path& folder);

/// Prints what could not be made, and where the report is, last.
void print_where(const WrittenReport& written, const std::filesystem::path& folder);

}  // namespace ccdt
