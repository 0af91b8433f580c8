/// @file
/// Critical loads and loads of given displacements by elements in extended precision, extrapolated to
/// infinitely many of them.
#pragma once

#include <optional>
#include <string>

#include "nlmech/frames/named/frame_model.hpp"

namespace nlmech::frame_deck {

/// What of a path from rest is asked for.
struct Question {
  /// The kind of point.
  enum class Kind { maximum, minimum, bifurcation, place };
  Kind kind = Kind::maximum;  ///< which
  int number = 1;             ///< of that kind on the path from rest
  std::string motion;         ///< "load.y": where it is, and for a place what is given
  double at = 0;              ///< of a place: the motion's displacement
  double until = 0;           ///< load factor to which to walk; 0: as FrameWalk without one
};

/// An answer.
struct Answer {
  long double load = 0;    ///< factor
  long double motion = 0;  ///< displacement of the question's motion
};

/// By elements of one number.
[[nodiscard]] std::optional<Answer> answer(const frames::FrameModel& model, int elements, const Question& q);

/// By elements of m, 2 m, ..., whose errors are a series of even powers of 1/m (Richardson).
struct Extrapolated {
  Answer answer;         ///< the last of the triangle
  long double last = 0;  ///< distance of the load from the one before it
};

/// @param least m
/// @param levels how many numbers of elements, at least 2
[[nodiscard]] std::optional<Extrapolated> extrapolated(const frames::FrameModel& model, int least, int levels,
                                                       const Question& q);

}  // namespace nlmech::frame_deck
