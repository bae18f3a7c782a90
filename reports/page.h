#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "reports/report.h"

namespace ccdt {

/// The page without data, which is built from reports/page. None if this build has none.
std::optional<std::string> page_template(const std::filesystem::path& share);

/// The page with all that it shows inside: the report, the meshes of the viewer, and the raw JSON of every run and
/// experiment, deflated. Files that are missing are left out.
///
/// \param folder  where the files are that the report names
std::string fill_page(const std::string& page, const Report& report, const std::filesystem::path& folder);

}  // namespace ccdt
