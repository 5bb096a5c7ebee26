#pragma once

#include <cstdint>

#include "conchoid/material/field_sample.hpp"

namespace conchoid {

/// Fractal noise: exp( a Σ_o g^o N_o(2^o x/c) / √Σ g^2o ), N_o gradient noise (Perlin 2002, quintic blend) of
/// mean 0 and standard deviation 1, each octave on a lattice of its own offset. So ln of the value has the
/// standard deviation a. The lattice edge c is chosen so that the first octave has the wavelength λ = 2π σ/σ'
/// along a line (σ' of its derivative): that of a sine which crosses zero as often.
struct Noise {
  double wavelength = 1;  ///< λ of the first octave [m], > 0
  double amplitude = 0;   ///< a ≥ 0
  int octaves = 4;        ///< each of half the wavelength of the one before
  double gain = 0.5;      ///< g: amplitude of an octave over that of the one before
  std::uint64_t seed = 1;

  FieldSample at(const Vec3& x) const;
};

}  // namespace conchoid
