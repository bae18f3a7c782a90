#include "engine/retry/remedies.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/retry/divide_facets.h"

namespace ccdt::retry {
namespace {

/// The pieces of segments, by their ends.
HashTable<std::uint64_t, PieceToSplit> list_pieces(const FailedAttempt& attempt) {
  HashTable<std::uint64_t, PieceToSplit> pieces;
  for (std::size_t s = 0; s < attempt.chains.size(); ++s) {
    const auto chain = attempt.chains[s];
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      pieces.insert(edge_key(chain[i].vertex, chain[i + 1].vertex),
                    {attempt.plc.segments[s].ends, chain[i].fraction, chain[i + 1].fraction});
  }
  return pieces;
}

/// The edges of the faces that are pieces of segments and not much shorter than the longest edge of the face.
std::vector<PieceToSplit> find_long_pieces(const FailedAttempt& attempt) {
  constexpr double long_share = 0.4;
  const auto pieces = list_pieces(attempt);
  std::vector<PieceToSplit> found;
  for (const std::uint32_t face : attempt.faces) {
    const auto& t = attempt.facets.triangles[face];
    std::array<double, 3> squares{};
    for (std::size_t k = 0; k < 3; ++k)
      squares[k] = squared_length(attempt.points[t[(k + 1) % 3]] - attempt.points[t[k]]);
    for (std::size_t k = 0; k < 3; ++k) {
      if (squares[k] < long_share * long_share * std::ranges::max(squares)) continue;
      if (const PieceToSplit* piece = pieces.find(edge_key(t[k], t[(k + 1) % 3]))) found.push_back(*piece);
    }
  }
  std::ranges::sort(found);
  const auto repeated = std::ranges::unique(found);
  found.erase(repeated.begin(), repeated.end());
  return found;
}

/// The parts of facets that are not exactly flat.
std::vector<plc::FacetPart> parts_at_faces(const FailedAttempt& attempt) {
  const auto& points = attempt.points;
  std::vector<plc::FacetPart> parts;
  HashTable<std::uint32_t, Point3> normals;  // of the facets
  for (const std::uint32_t face : attempt.faces) {
    const FacetId facet = attempt.facets.facet[face];
    if (attempt.plc.facets[facet].exactly_flat) continue;
    const auto [normal, is_new] = normals.insert(facet, {});
    if (is_new) *normal = plc::sum_of_normals(attempt.plc.triangles_of(attempt.plc.facets[facet]), points);
    const auto& [a, b, c] = attempt.facets.triangles[face];
    parts.push_back({{points[a], points[b], points[c]}, *normal});
  }
  return parts;
}

/// \return  false if all these parts are divided already
bool divide(std::span<const plc::FacetPart> parts, std::vector<plc::FacetPart>& divided) {
  const std::size_t before = divided.size();
  const auto is_divided = [&](const plc::FacetPart& part) {
    return std::ranges::any_of(std::span(divided).first(before),
                               [&](const auto& other) { return overlap(part, other); });
  };
  for (const plc::FacetPart& part : parts)
    if (!is_divided(part)) divided.push_back(part);
  return divided.size() > before;
}

/// The piece in the chain of a segment, if it is there.
std::optional<protection::PieceEnds> find_ends(std::span<const protection::ChainVertex> chain,
                                               const PieceToSplit& piece) {
  for (std::size_t i = 0; i + 1 < chain.size(); ++i)
    if (chain[i].fraction == piece.from && chain[i + 1].fraction == piece.to)
      return protection::PieceEnds{chain[i].vertex, chain[i + 1].vertex};
  return std::nullopt;
}

}  // namespace

bool add_remedy(const FailedAttempt& attempt, Remedies& remedies) {
  constexpr int most_local = 30;
  remedies.last_is_split = false;
  if (++remedies.count > most_local) return plc::tighten({}, remedies.strictness);
  if (attempt.faces.size() < remedies.fewest_faces && !attempt.faces.empty()) {
    remedies.fewest_faces = attempt.faces.size();
    if (std::vector<PieceToSplit> pieces = find_long_pieces(attempt); !pieces.empty()) {
      remedies.splits.push_back(std::move(pieces));
      return remedies.last_is_split = true;
    }
  }
  const std::vector<plc::FacetPart> parts = parts_at_faces(attempt);
  if (!remedies.follow_input && divide(parts, remedies.divided)) return true;
  remedies.follow_input = true;
  remedies.divided.clear();
  return plc::tighten(parts, remedies.strictness);
}

bool replace_remedy(Remedies& remedies) {
  if (remedies.last_is_split) remedies.splits.pop_back();
  const bool followed_input = std::exchange(remedies.follow_input, true);
  return std::exchange(remedies.last_is_split, false) || !followed_input;
}

protection::ProtectedDelaunay split_pieces(const plc::Plc& plc, protection::ProtectedDelaunay surface,
                                           const Remedies& remedies, protection::Protection strategy,
                                           const Progress& progress) {
  if (remedies.splits.empty()) return surface;
  HashTable<std::uint64_t, std::uint32_t> segments;  // by their ends
  for (std::uint32_t s = 0; s < plc.segments.size(); ++s) {
    const auto [a, b] = plc.segments[s].ends;
    segments.set(edge_key(a, b), s);
  }
  for (const std::vector<PieceToSplit>& round : remedies.splits) {
    std::vector<protection::PieceEnds> pieces;
    for (const PieceToSplit& piece : round) {
      const std::uint32_t* const s = segments.find(edge_key(piece.segment[0], piece.segment[1]));
      if (s == nullptr || plc.segments[*s].ends != piece.segment) continue;
      const auto ends = find_ends(surface.chains[*s], piece);
      if (!ends) continue;
      surface.must_be_chain[*s] = true;
      pieces.push_back(*ends);
    }
    surface = protection::protect_edges(plc, std::move(surface), strategy, progress, pieces);
  }
  return surface;
}

}  // namespace ccdt::retry
