#pragma once

#include <gtest/gtest.h>

#include "pair_table.hpp"

namespace conchoid::oracle {

inline void expect_accurate(const std::vector<NamedPair>& pairs) {
  for (const NamedPair& pair : pairs) {
    const Family single = single_layer(pair.x, pair.y, 1e-11);
    const Vec3 dbl = double_layer(pair.x, pair.y, 1e-11);
    const Vec3 back = double_layer(pair.y, pair.x, 1e-11);
    for (double tolerance : {1e-4, 1e-7, 1e-10}) {
      const PairIntegrator integrator(tolerance);
      EXPECT_LE(relative_error(family(integrator.single_layer(pair.x, pair.y)), single), tolerance)
          << "single layer, " << pair.name;
      EXPECT_LE(double_layer_error(pair.x, pair.y, vector(integrator.double_layer(pair.x, pair.y)), dbl),
                tolerance)
          << "double layer, " << pair.name;
      EXPECT_LE(double_layer_error(pair.y, pair.x, vector(integrator.double_layer(pair.y, pair.x)), back),
                tolerance)
          << "double layer, exchanged, " << pair.name;
    }
  }
}

}  // namespace conchoid::oracle
