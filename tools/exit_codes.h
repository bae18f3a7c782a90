#pragma once

namespace ccdt {

/// What the program's exit code means; part of its interface.
enum ExitCode : int { done = 0, failed_a_check = 1, wrong_usage = 2, bad_input = 3, limit_reached = 4 };

}  // namespace ccdt
