// The problem of one contact of a body that turns, with the others held: its block of W is full, and it is solved
// exactly in the contact's own frame (cd/discrete/one_contact.hpp and, with rolling resistance, bounded_block.hpp have
// the solutions and their sources). Order of the numbers: n, the directions across(n), then with rolling resistance the
// rotation (disks), or its parts along the same directions and along n (spheres).
#pragma once

#include "cd/discrete/one_contact.hpp"
#include "cd/laws/bounded_block.hpp"
#include "cd/problem.hpp"

namespace galet::cd {

/// Components by the contact's own directions, and back.
template <Layout Y>
inline Reaction<Y> in_frame(const Eigen::Matrix<double, Y.dim, Y.dim - 1>& tangents, const Components<Y>& parts) {
  Reaction<Y> values;
  values[0] = parts.normal;
  if constexpr (Y.dim == 2) {
    values[1] = parts.tangential;
    if constexpr (Y.rolling) values[2] = parts.rolling;
  } else {
    values.template segment<2>(1) = tangents.transpose() * parts.tangential;
    if constexpr (Y.rolling) {
      values.template segment<2>(3) = tangents.transpose() * parts.rolling;
      values[5] = parts.pivoting;
    }
  }
  return values;
}
template <Layout Y>
inline Components<Y> from_frame(const Eigen::Matrix<double, Y.dim, Y.dim - 1>& tangents, const Reaction<Y>& values) {
  Components<Y> parts;
  parts.normal = values[0];
  if constexpr (Y.dim == 2) {
    parts.tangential = values[1];
    if constexpr (Y.rolling) parts.rolling = values[2];
  } else {
    parts.tangential = tangents * values.template segment<2>(1);
    if constexpr (Y.rolling) {
      parts.rolling = tangents * values.template segment<2>(3);
      parts.pivoting = values[5];
    }
  }
  return parts;
}

/// New impulse of contact k; `motion` is its law_motion() for the impulse r.
template <Layout Y>
inline Components<Y> solve_turning_contact(const Problem<Y>& problem, std::size_t k, const Components<Y>& motion,
                                           const Components<Y>& r) {
  if constexpr (!Y.friction) {
    return {};  // bodies that turn have the layout with friction
  } else {
    constexpr int D = Y.dim;
    const auto tangents = across<D>(problem.normal[k]);
    const auto& w = problem.bent[k - problem.first_turning].w;
    const ContactLaw& law = problem.laws[problem.law[k]];
    const Reaction<Y> before = in_frame<Y>(tangents, r);
    const Reaction<Y> others = in_frame<Y>(tangents, motion) - w * before;
    if constexpr (!Y.rolling)
      return from_frame<Y>(tangents, solve_contact(w, others, Cone<D>{.mu = law.friction}, before));
    else if constexpr (D == 2)
      return from_frame<Y>(tangents,
                           BoundedBlock<3, 2>(w, others, {1, 2, 3}, {law.friction, law.rolling}).solve(before));
    else
      return from_frame<Y>(
          tangents,
          BoundedBlock<6, 3>(w, others, {1, 3, 5, 6}, {law.friction, law.rolling, law.pivoting}).solve(before));
  }
}

}  // namespace galet::cd
