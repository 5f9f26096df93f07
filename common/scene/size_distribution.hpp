// Distributions of diameters. Shares are by number or by volume; draws and means are always by number, so that shares
// by volume are turned into shares by number first: with x the diameter, n(x) ~ v(x) / x^D.
//
//   uniform, by number   n(x) constant on [mean (1 - s), mean (1 + s)]
//   uniform, by volume   v(x) constant there: n(x) ~ x^-D
//   discrete             given values with given shares (two: bidisperse)
#pragma once

#include "common/scene/scene.hpp"

namespace galet {

/// The diameter below which the share u, in [0, 1), of the grains lies.
double diameter_at(const SizeDistribution& sizes, int dimension, double u);

/// <x^power>, by number. Power 1: d, the mean diameter.
double mean_power(const SizeDistribution& sizes, int dimension, int power);

double largest_diameter(const SizeDistribution& sizes);

}  // namespace galet
