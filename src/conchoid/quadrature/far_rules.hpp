#pragma once

namespace conchoid {

/// Which layer's kernel: the double layer varies faster.
enum class Layer { single, dbl };

/// Lowest degree of a triangle rule that integrates the layer's potential over a panel of that radius to the
/// relative tolerance, when no source is closer to the panel's center than `distance`; 0 when no rule does.
/// @param density  degree of a polynomial that the potential is multiplied by: it takes as much from the rule's
int far_degree(Layer layer, double radius, double distance, double tolerance, int density = 0);

}  // namespace conchoid
