#pragma once

#include <vector>

#include "reports/claims/claim_rows.h"

namespace ccdt::reports {

/// \name The claims on a subject, with their measures and without verdicts.
/// @{
std::vector<PaperClaim> time_claims(Results results);
std::vector<PaperClaim> quality_claims(Results results);
std::vector<PaperClaim> existence_claims(Results results);
/// @}

}  // namespace ccdt::reports
