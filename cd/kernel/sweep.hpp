// One visit of each contact by Gauss-Seidel, and the residual, on W contacts at once: the equations of
// cd/laws/contact_bounds.hpp and cd/residual.hpp for rigid contacts of grains that roll freely (no lag, no compliance).
#pragma once

#include "cd/kernel/pairs.hpp"

namespace galet::cd {

/// Sums of the contacts of a chunk, kept lane by lane whatever W is.
template <bool Cell, int D, int W>
struct RunningSums {
  using V = Lanes<W>;
  static constexpr int parts = group_lanes / W;
  V map[parts], impulse[parts], virial[Cell ? D * D : 1][parts];

  GALET_INLINE RunningSums() {
    for (int p = 0; p < parts; ++p) {
      map[p] = 0.0, impulse[p] = 0.0;
      for (auto& component : virial) component[p] = 0.0;
    }
  }
  GALET_INLINE void add_to(SweepSums& sums) const {
    for (int p = 0; p < parts; ++p) {
      const auto add = [&](V value, double* sum) { (V::load(sum + p * W) + value).store(sum + p * W); };
      add(map[p], sums.map), add(impulse[p], sums.impulse);
      if constexpr (Cell)
        for (int a = 0; a < D * D; ++a) add(virial[a][p], sums.virial[a]);
    }
  }
};

/// W contacts of a group, from lane `lane` on.
template <Layout Y, bool Cell, int W>
class ContactLanes {
 public:
  using V = Lanes<W>;
  using C = SweepColumns<Y>;
  static constexpr int D = Y.dim, R = reaction_size(Y);
  using Vector = typename VectorOf<D, V>::type;

  GALET_INLINE ContactLanes(const SweepView& view, std::size_t group, int lane)
      : where_i(view.where + 8 * group + lane),
        where_j(where_i + group_lanes),
        columns(view.contacts + group * (C::count * group_lanes) + lane),
        reaction(view.reactions + group * (2 * R * group_lanes) + lane) {
    i.load(view.bodies, where_i), j.load(view.bodies, where_j);
    if constexpr (D == 2)
      n = {column(0), column(1)};
    else
      n = {column(0), column(1), column(2)};
  }

  GALET_INLINE V column(int index) const { return V::load(columns + index * group_lanes); }

  /// u_N with its offset, and u_T (2D: its component, 3D: the whole u).
  GALET_INLINE void measure(const SweepView& view) {
    Vector u = j.velocity() - i.velocity();
    if constexpr (Cell) {
      const V distance = column(C::distance);
      const double* l = view.gradient;
      if constexpr (D == 2) {
        u = {madd(distance, madd(V(l[0]), n.x, V(l[1]) * n.y), u.x),
             madd(distance, madd(V(l[2]), n.x, V(l[3]) * n.y), u.y)};
      } else {
        const auto row = [&](int a) { return madd(V(l[a]), n.x, madd(V(l[a + 1]), n.y, V(l[a + 2]) * n.z)); };
        u = {madd(distance, row(0), u.x), madd(distance, row(3), u.y), madd(distance, row(6), u.z)};
      }
    }
    if constexpr (Y.friction && D == 3) {
      const V arm_i = column(C::arm_i), arm_j = column(C::arm_j);
      u = madd_cross(n, madd(arm_i, i.spin(), arm_j * j.spin()), u);
      motion = u;
    }
    normal_part = dot(n, u);
    normal_motion = normal_part + column(C::offset);
    if constexpr (Y.friction && D == 2) {
      const V turning = madd(column(C::arm_i), i.record[2], column(C::arm_j) * j.record[2]);
      motion = msub(n.x, u.y, n.y * u.x) - turning;
    }
  }

  /// Gives the impulse p (on j) to the bodies.
  GALET_INLINE void push(const V (&p)[R]) {
    Vector whole;
    if constexpr (!Y.friction)
      whole = p[0] * n;
    else if constexpr (D == 2)
      whole = {nmadd(p[1], n.y, p[0] * n.x), madd(p[1], n.x, p[0] * n.y)};
    else
      whole = {p[0], p[1], p[2]};
    add(i.record, -i.inverse_mass(), whole), add(j.record, j.inverse_mass(), whole);
    if constexpr (Y.friction && D == 2) {
      i.record[2] = nmadd(column(C::turn_i), p[1], i.record[2]);
      j.record[2] = nmadd(column(C::turn_j), p[1], j.record[2]);
    }
    if constexpr (Y.friction && D == 3) {
      const Vector turn = cross(n, whole);
      add(i.second, -(column(C::arm_i) * i.second[3]), turn);
      add(j.second, -(column(C::arm_j) * j.second[3]), turn);
    }
    impulse = whole;
  }

  GALET_INLINE void add_virial(V (&virial)[D * D][group_lanes / W], int part) const {
    const V distance = column(C::distance);
    const auto row = [&](int a, V p) {
      const V weighted = distance * p;
      virial[D * a][part] = madd(weighted, n.x, virial[D * a][part]);
      virial[D * a + 1][part] = madd(weighted, n.y, virial[D * a + 1][part]);
      if constexpr (D == 3) virial[D * a + 2][part] = madd(weighted, n.z, virial[D * a + 2][part]);
    };
    row(0, impulse.x), row(1, impulse.y);
    if constexpr (D == 3) row(2, impulse.z);
  }

  const std::uint32_t *where_i, *where_j;
  const double* columns;
  double* reaction;
  BodyLanes<Y, W> i, j;
  Vector n, impulse;
  V normal_part, normal_motion;
  std::conditional_t<D == 3, Space<V>, V> motion;

 private:
  GALET_INLINE static void add(V (&record)[4], V factor, const Vector& p) {
    record[0] = madd(factor, p.x, record[0]), record[1] = madd(factor, p.y, record[1]);
    if constexpr (D == 3) record[2] = madd(factor, p.z, record[2]);
  }
};

/// The part of a vector of squared norm `square` that stays within `bound`.
template <int W>
GALET_INLINE Lanes<W> share_within(Lanes<W> bound, Lanes<W> square) {
  return select(square > bound * bound, bound / sqrt(square), Lanes<W>(1.0));
}

/// A visit in its stages, so that those of two groups can alternate: each is a long chain of operations that wait for
/// one another, and none of the other group's.
template <Layout Y, bool Cell, int W>
class Visit {
 public:
  using V = Lanes<W>;
  using C = SweepColumns<Y>;
  static constexpr int D = Y.dim, R = reaction_size(Y);

  GALET_INLINE Visit(const SweepView& view, std::size_t group, int lane) : contact_(view, group, lane) {
    contact_.measure(view);
    for (int a = 0; a < R; ++a) {
      const V r = V::load(contact_.reaction + a * group_lanes);
      double* before = contact_.reaction + (R + a) * group_lanes;
      start_[a] = madd(V(view.beta), r - V::load(before), r);
      r.store(before);
    }
  }

  GALET_INLINE void solve(RunningSums<Cell, D, W>& sums, int part) {
    V after[R];
    solve(after);
    V map = 0.0, impulse = 0.0;
    for (int a = 0; a < R; ++a) {
      change_[a] = after[a] - start_[a];
      after[a].store(contact_.reaction + a * group_lanes);
      map = madd(change_[a], change_[a], map), impulse = madd(after[a], after[a], impulse);
    }
    const V weight = contact_.i.inverse_mass() + contact_.j.inverse_mass();
    sums.map[part] = madd(weight, map, sums.map[part]);
    sums.impulse[part] = madd(weight, impulse, sums.impulse[part]);
  }

  GALET_INLINE void push(const SweepView& view, RunningSums<Cell, D, W>& sums, int part) {
    contact_.push(change_);
    if constexpr (Cell) contact_.add_virial(sums.virial, part);
    contact_.i.store(view.bodies, contact_.where_i, view.movable);
    contact_.j.store(view.bodies, contact_.where_j, view.movable);
  }

 private:
  GALET_INLINE void solve(V (&after)[R]) const {
    const auto& n = contact_.n;
    const V inverse_wn = contact_.column(C::inverse_wn);
    if constexpr (!Y.friction) {
      after[0] = max(nmadd(contact_.normal_motion, inverse_wn, start_[0]), V(0.0));
    } else if constexpr (D == 2) {
      after[0] = max(nmadd(contact_.normal_motion, inverse_wn, start_[0]), V(0.0));
      const V bound = contact_.column(C::friction) * after[0];
      after[1] = max(min(nmadd(contact_.motion, contact_.column(C::inverse_wt), start_[1]), bound), -bound);
    } else {
      const Space<V> y{start_[0], start_[1], start_[2]};
      const V normal = max(nmadd(contact_.normal_motion, inverse_wn, dot(n, y)), V(0.0));
      const V bound = contact_.column(C::friction) * normal;
      const Space<V> trial = nmadd(contact_.column(C::inverse_wt), contact_.motion, y);
      const Space<V> tangential = nmadd(dot(n, trial), n, trial);
      const Space<V> whole = madd(normal, n, share_within(bound, squared(tangential)) * tangential);
      after[0] = whole.x, after[1] = whole.y, after[2] = whole.z;
    }
  }

  ContactLanes<Y, Cell, W> contact_;
  V start_[R], change_[R];
};

template <Layout Y, bool Cell, int W>
GALET_INLINE void measure_residual(const SweepView& view, std::size_t group, int lane,
                                   RunningSums<Cell, Y.dim, W>& sums) {
  using V = Lanes<W>;
  using C = SweepColumns<Y>;
  constexpr int D = Y.dim;
  ContactLanes<Y, Cell, W> contact(view, group, lane);
  contact.measure(view);
  const int part = lane / W;
  const V inverse_wn = contact.column(C::inverse_wn);
  const Mask<W> movable = V(0.0) < inverse_wn;
  const auto add = [&](V weight, V map, V impulse) {
    sums.map[part] = sums.map[part] + only(movable, weight * map);
    sums.impulse[part] = sums.impulse[part] + only(movable, weight * impulse);
  };
  const auto r = [&](int a) { return V::load(contact.reaction + a * group_lanes); };
  if constexpr (!Y.friction) {
    const V miss = r(0) - max(nmadd(contact.normal_motion, inverse_wn, r(0)), V(0.0));
    add(V(1.0) / inverse_wn, miss * miss, r(0) * r(0));
  } else {
    const V mu = contact.column(C::friction);
    const V weight = (V(1.0) / inverse_wn + V(D - 1.0) / contact.column(C::inverse_wt)) * V(1.0 / D);
    const V inverse = V(1.0) / weight;
    V normal, speed;
    std::conditional_t<D == 3, Space<V>, V> tangential, trial;
    if constexpr (D == 2) {
      normal = r(0), tangential = r(1);
      trial = nmadd(contact.motion, inverse, tangential);
      speed = sqrt(contact.motion * contact.motion);
    } else {
      const auto& n = contact.n;
      const Space<V> whole{r(0), r(1), r(2)}, sliding = nmadd(contact.normal_part, n, contact.motion);
      normal = dot(n, whole), tangential = nmadd(normal, n, whole);
      trial = nmadd(inverse, sliding, tangential);
      speed = sqrt(squared(sliding));
    }
    // The projection on the cone: with the tangential part cut, and without where it then lies inside.
    const V z = nmadd(madd(mu, speed, contact.normal_motion), inverse, normal), norm = sqrt(squared(trial));
    const V cut = max(madd(mu, norm, z) / madd(mu, mu, V(1.0)), V(0.0));
    const V projected = select(mu * cut < norm, cut, max(z, V(0.0)));
    const V kept = select(mu * projected < norm, (mu * projected) / norm, V(1.0));
    const auto miss = tangential - kept * trial;
    const V miss_normal = normal - projected;
    add(weight, madd(miss_normal, miss_normal, squared(miss)), madd(normal, normal, squared(tangential)));
  }
}

template <Layout Y, bool Cell, int W>
void sweep_groups(const SweepView& given, std::size_t begin, std::size_t end, SweepSums& sums) {
  using Lane = Visit<Y, Cell, W>;
  const SweepView view = given;  // a copy that nothing else can change: it stays in registers
  RunningSums<Cell, Y.dim, W> running;
  std::size_t group = begin;
  for (; group + 2 <= end; group += 2)
    for (int lane = 0; lane < group_lanes; lane += W) {
      Lane first(view, group, lane), second(view, group + 1, lane);
      first.solve(running, lane / W), second.solve(running, lane / W);
      first.push(view, running, lane / W), second.push(view, running, lane / W);
    }
  if (group < end)
    for (int lane = 0; lane < group_lanes; lane += W) {
      Lane only(view, group, lane);
      only.solve(running, lane / W);
      only.push(view, running, lane / W);
    }
  running.add_to(sums);
}

template <Layout Y, bool Cell, int W>
void residual_of_groups(const SweepView& given, std::size_t begin, std::size_t end, SweepSums& sums) {
  const SweepView view = given;
  RunningSums<Cell, Y.dim, W> running;
  for (std::size_t group = begin; group < end; ++group)
    for (int lane = 0; lane < group_lanes; lane += W) measure_residual<Y, Cell, W>(view, group, lane, running);
  running.add_to(sums);
}

template <Layout Y, int W>
SweepFunctions sweep_functions_of_width(bool cell) {
  if (cell) return {sweep_groups<Y, true, W>, residual_of_groups<Y, true, W>};
  return {sweep_groups<Y, false, W>, residual_of_groups<Y, false, W>};
}

}  // namespace galet::cd
