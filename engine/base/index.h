#pragma once

#include <compare>
#include <cstdint>

namespace ccdt {

/// Stands for a missing index or code of 32 bits.
inline constexpr std::uint32_t none = 0xFFFFFFFFu;

/// An index that cannot be mistaken for an index of another kind.
///
/// It converts implicitly to an integer, so that it can subscript arrays. An integer or an index of another kind must
/// be converted explicitly.
template <class Tag>
struct Index {
  std::uint32_t value = none;

  constexpr Index() = default;
  constexpr explicit Index(std::uint32_t v) : value(v) {}
  template <class Integer>
  constexpr explicit Index(Integer v) : value(static_cast<std::uint32_t>(v)) {}

  constexpr operator std::uint32_t() const { return value; }
  constexpr bool is_none() const { return value == none; }
  constexpr auto operator<=>(const Index&) const = default;
  constexpr bool operator==(const Index&) const = default;
};

using VertexId = Index<struct VertexTag>;
using FacetId = Index<struct FacetTag>;
using RegionId = Index<struct RegionTag>;
using CellId = Index<struct CellTag>;

}  // namespace ccdt
