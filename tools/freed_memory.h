#pragma once

namespace ccdt::tools {

/// From now on, this process keeps the memory that it frees. New pages are expensive: the system clears each of them.
/// So the arrays of one stage go to the next one rather than back to the system. On Linux, large ones share a
/// `PagePool`.
///
/// Other meshers that run within this process should not get it: they are measured as they are.
void keep_freed_memory();

}  // namespace ccdt::tools
