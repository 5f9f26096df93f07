// Fabric of the contacts between grains, and the anisotropies of contacts and forces that make the stress deviate.
//
//   F     = <n (x) n>                                  orientation tensor, trace 1
//   chi_N = <F_N n (x) n> / <F_N>,  chi_T = sym <F_T (x) n> / <F_N>
//   contact    X_c = dev F                             a_c: density of contacts by direction
//   normal     X_n = dev chi_N - dev F                 a_n: mean normal force by direction
//   tangential X_t = chi_T                             a_t: mean tangential force by direction (traceless)
//   branch     X_l = dev sym <F (x) b> / <F.b> - dev chi_N - X_t     a_l: branch length, and how it goes with forces
// <.> over the contacts between grains that touch, F force on j, n normal, b branch vector. With e_1 and e_D the
// directions of the major and the minor principal stress of these contacts, each anisotropy is
//   a = s (e_1.X e_1 - e_D.X e_D),   s = 2 in 2D, 5/2 in 3D
// These are, to first order, the coefficients of (theta: angle from e_1)
//   2D   p = (1 + a_c cos 2 theta) / 2 pi,          F_N = f (1 + a_n cos 2 theta),           F_T = -f a_t sin 2 theta
//   3D   p = (1 + a_c (3 cos^2 theta - 1)) / 4 pi,  F_N = f (1 + a_n (3 cos^2 theta - 1)),   F_T = -f a_t sin 2 theta
// (3D: axial symmetry; F_T along growing theta). Positive where contacts and forces go along the major stress, with
// tangential forces that help to carry it. Because X_l is what remains, the stress-force-fabric relation
//   (sigma_1 - sigma_D) / tr sigma = (a_c + a_n + a_t + a_l) / s
// holds to rounding for the contact stress of these contacts; in the literature the last term, small for narrow size
// distributions, and products of anisotropies are often left out.
// Sources: Rothenburg and Bathurst 1989 (2D, Fourier); Azema and Radjai 2014 (tensors, s). No meaning, hence not a
// number, without contacts or where <F_N> is not above 0 (cohesion). Contacts with planes have the planes' directions
// and are left out. Cost: one pass.
#pragma once

#include "common/engine/snapshot.hpp"

namespace galet {

template <int D>
struct Fabric {
  long contacts = 0;
  double mean_normal_force = 0;         ///< <F_N>
  Mat<D> orientation = Mat<D>::Zero();  ///< F
  Mat<D> contact = Mat<D>::Zero();      ///< X_c
  Mat<D> normal = Mat<D>::Zero();       ///< X_n
  Mat<D> tangential = Mat<D>::Zero();   ///< X_t
  Mat<D> branch = Mat<D>::Zero();       ///< X_l
  Vec<D> major = Vec<D>::Zero();        ///< e_1
  Vec<D> minor = Vec<D>::Zero();        ///< e_D
};

template <int D>
Fabric<D> fabric(const Snapshot<D>& snapshot);

struct Anisotropies {
  double contact = 0;     ///< a_c
  double normal = 0;      ///< a_n
  double tangential = 0;  ///< a_t
  double branch = 0;      ///< a_l
  double sum() const { return contact + normal + tangential + branch; }
};

/// s of the header.
template <int D>
inline constexpr double anisotropy_scale = D == 2 ? 2.0 : 2.5;

template <int D>
Anisotropies anisotropies(const Fabric<D>& fabric);

extern template Fabric<2> fabric<2>(const Snapshot<2>&);
extern template Fabric<3> fabric<3>(const Snapshot<3>&);
extern template Anisotropies anisotropies<2>(const Fabric<2>&);
extern template Anisotropies anisotropies<3>(const Fabric<3>&);

}  // namespace galet
