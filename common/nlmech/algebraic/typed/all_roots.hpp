/// @file
/// All roots of typed equations in a box, with proof.
#pragma once

#include <cstdint>
#include <vector>

#include "nlmech/algebraic/typed/root_check.hpp"
#include "nlmech/support/status.hpp"

namespace nlmech::algebraic {

/// A part of the box.
struct RootBox {
  Box box;         ///< encloses the root, or is undecided
  bool is_proved;  ///< holds exactly one root; else it may hold any number
};

/// Result of the search.
struct AllRoots {
  std::vector<RootBox> boxes;  ///< proved ones by their first unknown, then undecided ones
  Status status;               ///< success: no box is undecided; else how many are, and why
  std::int64_t examined = 0;   ///< boxes examined
};

/// Limits of the search.
struct AllRootsOptions {
  std::int64_t boxes = 1'000'000;  ///< largest number of boxes examined
  double seconds = 60;             ///< largest wall time
  double width = 1e-8;             ///< boxes below this part of the given one are not divided further
};

/// Finds all roots in @p box by bisection: a box is dropped if an enclosure of F or Krawczyk's operator shows
/// that it has no root, and has exactly one if the operator maps it into itself. All else is undecided: the
/// neighbourhood of a singular root, of a kink or jump, of points where F does not exist. All rounding is
/// outwards. A root on the edge of the box counts. Bounds of the unknowns cut the box.
/// @throws std::invalid_argument if the box has another size than the equations or an infinite side
[[nodiscard]] AllRoots all_roots(const TypedSystem& system, const Box& box,
                                 const AllRootsOptions& options = {});

}  // namespace nlmech::algebraic
