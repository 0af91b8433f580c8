/// @file
/// A load that is a sum of sines and cosines: what problems announce and integrators may treat exactly.
#pragma once

namespace nlmech {

/// One harmonic of a load: it adds cosine cos(frequency t) + sine sin(frequency t) to one component of dx/dt.
/// Frequency 0 is a constant load, `cosine`.
struct Harmonic {
  int component = 0;     ///< of the state, from 0; for a problem with accelerations one of the velocities
  double frequency = 0;  ///< rad/time, finite
  double cosine = 0;     ///< amplitude of the cosine
  double sine = 0;       ///< amplitude of the sine
};

}  // namespace nlmech
