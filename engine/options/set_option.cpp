#include "engine/options/set_option.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

#include "engine/base/check_arguments.h"
#include "engine/base/digits.h"
#include "engine/base/errors.h"
#include "engine/base/platform.h"

namespace ccdt::options {
namespace {

[[noreturn]] void refuse(const MeshOption& option, std::string_view value, const std::string& remedy) {
  throw InputError("the option " + std::string(option.name) + " cannot be " + std::string(value), {}, remedy);
}

std::string list_of(const std::vector<ChoiceKind::Name>& names) {
  std::string list;
  for (const auto& [name, what] : names) list += (list.empty() ? "" : ", ") + std::string(name);
  return list;
}

/// \throw InputError  the value is outside of the bounds
struct BoundsCheck {
  const MeshOption& option;
  double value;

  void operator()(const NumberKind& kind) const {
    const double most = std::min(kind.most, largest_argument);
    if (kind.excludes_least ? value > kind.least && value <= most : value >= kind.least && value <= most) return;
    const std::string least = (kind.excludes_least ? "greater than " : "of at least ") + digits(kind.least);
    refuse(option, digits(value),
           "give a number " + least + (std::isfinite(kind.most) ? " and at most " + digits(most) : ""));
  }
  void operator()(const CountKind& kind) const {
    if (value >= kind.least && value <= kind.most && value == std::floor(value)) return;
    refuse(option, digits(value),
           "give a whole number from " + std::to_string(kind.least) + " to " + std::to_string(kind.most));
  }
  void operator()(const ChoiceKind&) const {}
  void operator()(const FileKind&) const {}
};

/// \throw InputError  the text is no value of the option
struct ValueCheck {
  const MeshOption& option;
  std::string_view text;

  void operator()(const ChoiceKind& kind) const {
    if (std::ranges::find(kind.names, text, &ChoiceKind::Name::name) == kind.names.end())
      refuse(option, "'" + std::string(text) + "'", "give one of " + list_of(kind.names));
  }
  void operator()(const FileKind&) const {}
  void operator()(const auto& number) const {
    double value = 0;
    const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      refuse(option, "'" + std::string(text) + "'", "give a number");
    BoundsCheck{option, value}(number);
  }
};

}  // namespace

void set_option(std::string_view name, std::string_view value, MeshOptions& options) {
  std::string known(name);
  std::ranges::replace(known, '_', '-');
  const MeshOption* const option = find_mesh_option(known);
  if (option == nullptr)
    throw InputError("there is no option " + std::string(name), {}, "give one that `ccdt mesh --help` lists");
  std::visit(ValueCheck{*option, value}, option->kind);
  set_value(*option, value, options);
}

void check_bounds(const MeshOption& option, const MeshOptions& options) {
  static const MeshOptions defaults;
  const OptionValue value = recorded_value(option, options);
  const double* const number = std::get_if<double>(&value);
  if (number != nullptr && value != recorded_value(option, defaults))
    std::visit(BoundsCheck{option, *number}, option.kind);
}

}  // namespace ccdt::options
