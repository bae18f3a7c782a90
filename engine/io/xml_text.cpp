#include "engine/io/xml_text.h"

#include <boost/locale/utf.hpp>

namespace ccdt::io {

std::string xml_text(std::string_view text) {
  using Utf8 = boost::locale::utf::utf_traits<char>;
  std::string result;
  while (!text.empty()) {
    const char* next = text.begin();
    const auto code = Utf8::decode(next, text.end());
    const bool is_text =
        (code >= ' ' && code <= '~') || (code > 0x9F && code <= 0x10FFFF && code != 0xFFFE && code != 0xFFFF);
    const auto length = is_text ? static_cast<std::size_t>(next - text.begin()) : 1;
    if (code == '&' || code == '<' || code == '>' || code == '"')
      result += "&#" + std::to_string(code) + ";";
    else
      result += is_text ? text.substr(0, length) : "_";
    text.remove_prefix(length);
  }
  return result;
}

}  // namespace ccdt::io
