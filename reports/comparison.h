#pragma once

#include <filesystem>

#include "reports/report.h"

namespace ccdt::reports {

/// Two folders beside each other, as a report of one section: which deterministic figures differ, which times are
/// outside of the interval that the first folder states, and which verdicts have changed. Rows belong together that
/// have the same labels.
///
/// \param into  the folder of the new report, which its files are named from
/// \throw InputError  one of the folders has no experiment
Report compare_reports(const std::filesystem::path& first, const std::filesystem::path& second,
                       const std::filesystem::path& into, std::span<const ReportChart> charts);

}  // namespace ccdt::reports
