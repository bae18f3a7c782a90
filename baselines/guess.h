#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ccdt::baselines {

/// "did you mean 'b'? ", with the name that is most like an unknown word; empty if none is like it.
std::string guess(std::string_view unknown, const std::vector<std::string>& known);

}  // namespace ccdt::baselines
