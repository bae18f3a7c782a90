#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ccdt::baselines {

/// "did you mean 'b'? ", with the name most similar to an unknown word; empty if none is similar.
std::string guess(std::string_view unknown, const std::vector<std::string>& known);

}  // namespace ccdt::baselines
