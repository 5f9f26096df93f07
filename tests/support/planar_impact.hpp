// An oblique impact in a plane, integrated directly: the contact laws of physics.md, section 1, as an ordinary
// differential equation, solved by the classical Runge-Kutta method. An oracle for md: it shares no code with it.
//
// Grain 0 and grain 1 (or a plane) with x = x_1 - x_0, u = v_1 - v_0, spins w_0 and w_1 about the third axis, n =
// x/|x|, t = n turned by 90 degrees, lever arms l_i = R_i |x| / (R_0 + R_1) (plane: l_0 = x.n):
//   u_N = u.n, u_T = u.t - l_0 w_0 - l_1 w_1, h = R_0 + R_1 - |x|, F on grain 1 = F_N n + F_T t,
//   m* du/dt = F, I_i dw_i/dt = -l_i F_T.
// Tangential spring S (its part of F_T, carried along with t):
//   dS/dt = -K_T d(delta)/dt + [h falls] S d(ln K_T)/dt.
//   `elastic`: sticks with d(delta)/dt = u_T and F_T = S - alpha_T u_T as long as |S| <= mu F_el; else S = F_T = +-mu
//   F_el. `total`:   F_T = S - alpha_T d(delta)/dt; d(delta)/dt = u_T as long as |F_T| <= mu N, else F_T = +-mu N;
//              N = max(0, F_el - alpha u_N).
#pragma once

#include <gtest/gtest.h>

#include "tests/support/scenes.hpp"

namespace galet::test {

struct PlanarLaw {
  NormalLaw normal_law = NormalLaw::linear;
  DampingConvention convention = DampingConvention::elastic;
  double coefficient = 1;  ///< K_N, or k of k h^(3/2)
  double ratio = 0.5;      ///< K_T / K_N
  double zeta = 0, zeta_t = 0;
  double friction = 0;
  bool rescales = true;  ///< S follows K_T when h falls (hertz)
};

struct PlanarBodies {
  std::array<double, 2> radius{0.5, 0.5}, mass{1, 1};
  double inertia_ratio = 0.5;  ///< I / (m R^2)
  bool plane = false;          ///< grain 1 is a plane; its normal is `normal`
  Vec<2> normal = Vec<2>(1, 0);

  double inverse_mass() const { return 1 / mass[0] + (plane ? 0 : 1 / mass[1]); }
  double inverse_tangential_mass() const { return inverse_mass() * (1 + 1 / inertia_ratio); }
  double inverse_inertia(int i) const {
    return i == 1 && plane ? 0 : 1 / (inertia_ratio * mass[i] * radius[i] * radius[i]);
  }
};

struct PlanarState {
  Vec<2> x = Vec<2>::Zero(), u = Vec<2>::Zero();
  double w0 = 0, w1 = 0;
  double spring = 0;
};

inline PlanarState operator+(const PlanarState& a, const PlanarState& b) {
  return {a.x + b.x, a.u + b.u, a.w0 + b.w0, a.w1 + b.w1, a.spring + b.spring};
}
inline PlanarState operator*(double factor, const PlanarState& a) {
  return {factor * a.x, factor * a.u, factor * a.w0, factor * a.w1, factor * a.spring};
}

class PlanarImpact {
 public:
  PlanarImpact(const PlanarLaw& law, const PlanarBodies& bodies) : law_(law), bodies_(bodies) {}

  /// Everything at one instant.
  struct View {
    Vec<2> n, t;
    double h, l0, l1, u_n, u_t;
    double elastic, repulsive, bound;  ///< F_el, what Coulomb's bound refers to, mu times that
    double tangential_stiffness;
    double normal_force, tangential_force, spring_rate;
  };

  View view(const PlanarState& at) const {
    View now;
    frame(at, now);
    const bool hertz = law_.normal_law == NormalLaw::hertz;
    const double h = std::max(now.h, 0.0), k = law_.coefficient;
    const double stiffness = hertz ? 1.5 * k * std::sqrt(h) : k;
    now.elastic = hertz ? k * h * std::sqrt(h) : k * h;
    now.tangential_stiffness = law_.ratio * stiffness;
    const double alpha = 2 * law_.zeta * std::sqrt(stiffness / bodies_.inverse_mass());
    const bool total = law_.convention == DampingConvention::total;
    now.repulsive = total ? std::max(0.0, now.elastic - alpha * now.u_n) : now.elastic;
    now.normal_force = total ? now.repulsive : now.elastic - alpha * now.u_n;
    now.bound = law_.friction * now.repulsive;
    tangential(at, now);
    return now;
  }

  /// From touching until h = 0 again, in steps of dt. `look` is called after each step with the time and the view.
  template <class Look>
  PlanarState run(PlanarState state, double dt, Look look) {
    sliding_ = 0;
    double time = 0;
    for (;;) {
      const int mode = sliding_;
      const PlanarState next = runge_kutta(state, dt);
      if (view(next).h <= 0 && time > 0)
        return stepped_to(state, dt, [&](const PlanarState& s) { return view(s).h > 0; });
      if (!has_modes()) {
        state = next;
        time += dt;
      } else if (mode == 0) {
        const auto sticks = [&](const PlanarState& s) { return std::abs(s.spring) <= view(s).bound; };
        if (sticks(next)) {
          state = next;
          time += dt;
        } else {
          sliding_ = 0;
          double advanced = 0;
          state = stepped_to(state, dt, sticks, &advanced);
          time += advanced;
          sliding_ = next.spring > 0 ? 1 : -1;
          state.spring = sliding_ * view(state).bound;
        }
      } else {
        state = after_sliding(state, next, dt);
        time += dt;
      }
      look(time, view(state));
    }
  }

  PlanarState run(const PlanarState& state, double dt) {
    return run(state, dt, [](double, const View&) {});
  }

 private:
  /// A tangential dashpot bounded with its spring makes the law smooth; else sticking and sliding are two modes.
  bool has_modes() const { return law_.convention == DampingConvention::elastic || law_.zeta_t == 0; }

  void frame(const PlanarState& at, View& now) const {
    if (bodies_.plane) {
      now.n = bodies_.normal;
      now.l0 = at.x.dot(now.n), now.l1 = 0;
      now.h = bodies_.radius[0] - now.l0;
    } else {
      const double distance = at.x.norm(), sum = bodies_.radius[0] + bodies_.radius[1];
      now.n = at.x / distance;
      now.l0 = bodies_.radius[0] * distance / sum, now.l1 = bodies_.radius[1] * distance / sum;
      now.h = sum - distance;
    }
    now.t = Vec<2>(-now.n.y(), now.n.x());
    now.u_n = at.u.dot(now.n);
    now.u_t = at.u.dot(now.t) - now.l0 * at.w0 - now.l1 * at.w1;
  }

  void tangential(const PlanarState& at, View& now) const {
    const double alpha_t = 2 * law_.zeta_t * std::sqrt(now.tangential_stiffness / bodies_.inverse_tangential_mass());
    const bool softens = law_.normal_law == NormalLaw::hertz && law_.rescales && now.u_n > 0 && now.h > 0;
    const double softening = softens ? -0.5 * now.u_n / now.h : 0;  // d(ln K_T)/dt, K_T ~ sqrt(h)
    if (has_modes()) {
      const double spring = sliding_ == 0 ? at.spring : sliding_ * now.bound;
      now.tangential_force = sliding_ == 0 ? spring - alpha_t * now.u_t : spring;
      now.spring_rate = -now.tangential_stiffness * now.u_t + softening * spring;  // sliding: a trial
      return;
    }
    double rate = now.u_t;
    now.tangential_force = at.spring - alpha_t * now.u_t;
    if (std::abs(now.tangential_force) > now.bound) {
      now.tangential_force = std::copysign(now.bound, now.tangential_force);
      rate = alpha_t > 0 ? (at.spring - now.tangential_force) / alpha_t : 0;
    }
    now.spring_rate = -now.tangential_stiffness * rate + softening * at.spring;
  }

  PlanarState derivative(const PlanarState& at) const {
    const View now = view(at);
    PlanarState rate;
    rate.x = at.u;
    rate.u = bodies_.inverse_mass() * (now.normal_force * now.n + now.tangential_force * now.t);
    rate.w0 = -now.l0 * now.tangential_force * bodies_.inverse_inertia(0);
    rate.w1 = -now.l1 * now.tangential_force * bodies_.inverse_inertia(1);
    rate.spring = now.spring_rate;
    return rate;
  }

  PlanarState runge_kutta(const PlanarState& y, double dt) const {
    const PlanarState a = derivative(y);
    const PlanarState b = derivative(y + dt / 2 * a);
    const PlanarState c = derivative(y + dt / 2 * b);
    const PlanarState d = derivative(y + dt * c);
    return y + dt / 6 * (a + 2 * b + 2 * c + d);
  }

  /// The last state within the next step for which `holds` is true.
  template <class Condition>
  PlanarState stepped_to(const PlanarState& y, double dt, Condition holds, double* advanced = nullptr) const {
    double low = 0, high = dt;
    for (int k = 0; k < 50; ++k) {
      const double middle = (low + high) / 2;
      (holds(runge_kutta(y, middle)) ? low : high) = middle;
    }
    if (advanced) *advanced = low;
    return low > 0 ? runge_kutta(y, low) : y;
  }

  /// Sliding goes on while the spring, left alone, would outgrow the bound. (`next.spring` went along as that trial:
  /// it started the step at the bound.)
  PlanarState after_sliding(const PlanarState& start, PlanarState next, double dt) {
    PlanarState on_bound = start;
    on_bound.spring = sliding_ * view(start).bound;
    const double bound = view(next).bound;
    const double trial = on_bound.spring + dt / 2 * (view(on_bound).spring_rate + view(next).spring_rate);
    if (sliding_ * trial < bound) {
      sliding_ = 0;
      next.spring = trial;
    } else {
      next.spring = sliding_ * bound;
    }
    return next;
  }

  PlanarLaw law_;
  PlanarBodies bodies_;
  int sliding_ = 0;  ///< 0 sticks, else the sign of the force that slides
};

}  // namespace galet::test
