// The problem of one contact of a body that turns, with the others held: its block of W is full, and it is solved
// exactly in the contact's own frame (cd/discrete/one_contact.hpp has the solution and its sources).
#pragma once

#include "cd/discrete/one_contact.hpp"
#include "cd/problem.hpp"

namespace galet::cd {

/// Components by the directions (n, across(n)), and back.
template <Layout Y>
inline Vec<Y.dim> in_frame(const Eigen::Matrix<double, Y.dim, Y.dim - 1>& tangents, const Components<Y>& parts) {
  Vec<Y.dim> values;
  values[0] = parts.normal;
  if constexpr (Y.dim == 2)
    values[1] = parts.tangential;
  else
    values.template tail<2>() = tangents.transpose() * parts.tangential;
  return values;
}
template <Layout Y>
inline Components<Y> from_frame(const Eigen::Matrix<double, Y.dim, Y.dim - 1>& tangents, const Vec<Y.dim>& values) {
  Components<Y> parts;
  parts.normal = values[0];
  if constexpr (Y.dim == 2)
    parts.tangential = values[1];
  else
    parts.tangential = tangents * values.template tail<2>();
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
    const Vec<D> before = in_frame<Y>(tangents, r);
    const Vec<D> others = in_frame<Y>(tangents, motion) - w * before;
    const Cone<D> cone{.mu = problem.laws[problem.law[k]].friction};
    return from_frame<Y>(tangents, solve_contact(w, others, cone, before));
  }
}

}  // namespace galet::cd
