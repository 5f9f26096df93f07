#include "common/scene/rigid_bodies.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "common/core/error.hpp"

namespace galet {

namespace {

/// Positions of a body's grains as one piece: each grain at the image nearest to the one it is joined to, nearest
/// grains first (Prim's tree).
template <int D>
std::vector<Vec<D>> in_one_piece(const Sample<D>& sample, const std::vector<int>& member) {
  std::vector<Vec<D>> place;
  for (const int grain : member) place.push_back(sample.position[grain]);
  if (!sample.cell.any_periodic()) return place;
  const Mat<D> inverse = sample.cell.box.inverse();
  const auto nearest = [&](const Vec<D>& from, const Vec<D>& x) {
    Vec<D> shift = inverse * (x - from);
    for (int a = 0; a < D; ++a) shift[a] = sample.cell.periodic[a] ? std::round(shift[a]) : 0;
    return Vec<D>(x - sample.cell.box * shift);
  };
  const std::size_t count = member.size();
  std::vector<double> distance(count, std::numeric_limits<double>::infinity());
  std::vector<char> joined(count, 0);
  for (std::size_t last = 0, left = count - 1; left > 0; --left) {
    joined[last] = 1;
    std::size_t next = count;
    for (std::size_t k = 0; k < count; ++k) {
      if (joined[k]) continue;
      const Vec<D> here = nearest(place[last], place[k]);
      const double gap = (here - place[last]).norm();
      if (gap < distance[k]) distance[k] = gap, place[k] = here;
      if (next == count || distance[k] < distance[next]) next = k;
    }
    last = next;
  }
  return place;
}

/// Moments of inertia of one grain about a point at `arm` from its centre.
template <int D>
SpinMap<D> inertia_about(double mass, double radius, const Vec<D>& arm) {
  const double own = inertia_ratio<D> * mass * radius * radius;
  if constexpr (D == 2)
    return own + mass * arm.squaredNorm();
  else
    return (own + mass * arm.squaredNorm()) * Mat<3>::Identity() - mass * arm * arm.transpose();
}

SpinMap<2> given_inertia(const std::vector<double>& values, double) { return values[0]; }
SpinMap<3> given_inertia(const std::vector<double>& v, const Mat<3>&) {
  return (Mat<3>() << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2]).finished();
}

void set_principal(const double& inertia, RigidBody<2>& body) { body.moments = inertia; }
void set_principal(const Mat<3>& inertia, RigidBody<3>& body) {
  Eigen::SelfAdjointEigenSolver<Mat<3>> axes(inertia);
  Mat<3> frame = axes.eigenvectors();
  if (frame.determinant() < 0) frame.col(0) *= -1;
  body.moments = axes.eigenvalues();
  body.orientation = Eigen::Quaterniond(frame).normalized();
}

template <int D>
Spin<D> spin_from(const std::vector<double>& values) {
  if (values.empty()) return zero_spin<D>();
  require(values.size() == (D == 2 ? 1 : 3), "a spin has 1 component in 2D and 3 in 3D");
  if constexpr (D == 2)
    return values[0];
  else
    return Vec<3>(values[0], values[1], values[2]);
}

template <int D>
Vec<D> vector_from(const std::vector<double>& values) {
  if (values.empty()) return Vec<D>::Zero();
  require(values.size() == D, "a vector has as many components as the scene has dimensions");
  return Eigen::Map<const Vec<D>>(values.data());
}

/// What the scene says of the body's motion; mass and inertia are known.
template <int D>
void set_motion(const BodySpec& spec, RigidBody<D>& body) {
  body.velocity = vector_from<D>(spec.velocity);
  body.force = vector_from<D>(spec.force);
  body.spin = spin_from<D>(spec.spin);
  body.torque = spin_from<D>(spec.torque);
  for (std::size_t a = 0; a < std::min<std::size_t>(D, spec.free.size()); ++a)
    if (spec.free[a]) body.mobility(a, a) = 1 / body.mass;
  if (!spec.guide.empty()) {
    const Vec<D> along = vector_from<D>(spec.guide).normalized();
    body.mobility = along * along.transpose() / body.mass;
  }
  const auto axes = std::count(spec.free_rotation.begin(), spec.free_rotation.end(), true);
  require(axes == 0 || axes == 1 || axes == static_cast<long>(spec.free_rotation.size()),
          "a body turns freely about no axis, one, or all");
  body.turns = turns(spec);
  if (axes == 0) return;
  body.turning = D == 3 && axes == 1 ? Turning::about_axis : Turning::free;
  if (body.turning == Turning::about_axis)
    body.axis = Vec<D>::Unit(std::find(spec.free_rotation.begin(), spec.free_rotation.end(), true) -
                             spec.free_rotation.begin());
  if (body.has_momentum()) body.momentum = angular_momentum(body);
}

/// A body that turns must not reach around the cell: what is glued across its border would be torn apart.
template <int D>
void check_reach(const BodySpec& spec, const Sample<D>& sample, const std::vector<int>& member,
                 const std::vector<Vec<D>>& place) {
  const Mat<D> inverse = sample.cell.box.inverse();
  const Vec<D> width = face_distances<D>(sample.cell.box);
  for (int a = 0; a < D; ++a) {
    if (!sample.cell.periodic[a]) continue;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < member.size(); ++k) {
      const double at = (inverse * place[k])[a], reach = sample.radius[member[k]] / width[a];
      low = std::min(low, at - reach), high = std::max(high, at + reach);
    }
    if (high - low >= 1)
      throw InputError(fmt::format("body '{}' reaches around the periodic direction {}, so that it can't turn",
                                   spec.name, "xyz"[a]));
  }
}

/// Mean over the directions of a blow of what it finds in place of 1 / mass.
template <int D>
double mean_inverse_mass(const RigidBody<D>& body, const Vec<D>& arm) {
  double inverse = body.mobility.trace() / D;
  const SpinMap<D> turning = turning_mobility(body);
  if constexpr (D == 2) {
    inverse += turning * arm.squaredNorm() / 2;
  } else {
    for (int a = 0; a < 3; ++a) {
      const Vec<3> lever = arm.cross(Vec<3>::Unit(a));
      inverse += lever.dot(turning * lever) / 3;
    }
  }
  return inverse;
}

template <int D>
RigidBody<D> make_body(const BodySpec& spec, const Sample<D>& sample, const std::vector<int>& member,
                       std::vector<Vec<D>>& place) {
  RigidBody<D> body;
  double mass = 0;
  Vec<D> centre = Vec<D>::Zero();
  for (std::size_t k = 0; k < member.size(); ++k) {
    mass += sample.mass[member[k]];
    centre += sample.mass[member[k]] * place[k];
  }
  body.mass = spec.mass.value_or(mass);
  body.centre = centre / mass;
  if (!spec.centre.empty()) {
    // The scene may write it in another image than the grains.
    Vec<D> away = sample.cell.box.inverse() * (vector_from<D>(spec.centre) - body.centre);
    for (int a = 0; a < D; ++a) away[a] = sample.cell.periodic[a] ? std::round(away[a]) : 0;
    body.centre = vector_from<D>(spec.centre) - sample.cell.box * away;
  }
  SpinMap<D> inertia = zero_map<D>();
  for (std::size_t k = 0; k < member.size(); ++k) {
    place[k] -= body.centre;
    inertia += inertia_about<D>(sample.mass[member[k]], sample.radius[member[k]], place[k]);
  }
  inertia *= body.mass / mass;
  if (!spec.inertia.empty()) {
    require(spec.inertia.size() == (D == 2 ? 1 : 6), "an inertia has 1 component in 2D and 6 in 3D");
    inertia = given_inertia(spec.inertia, inertia);
  }
  set_principal(inertia, body);
  set_motion<D>(spec, body);
  return body;
}

}  // namespace

template <int D>
RigidBodies<D> rigid_bodies(const Scene& scene, const Sample<D>& sample) {
  RigidBodies<D> bodies;
  if (sample.body.empty() || scene.bodies.empty()) return bodies;
  bodies.of = sample.body;
  bodies.group = contact_groups(scene, sample.body);
  bodies.first = {0};
  bodies.offset.assign(sample.position.size(), Vec<D>::Zero());
  bodies.contact_mass.assign(sample.mass.begin(), sample.mass.end());
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    std::vector<int> member;
    for (int i = 0; i < sample.count(); ++i)
      if (sample.body[i] == static_cast<int>(b)) member.push_back(i);
    if (member.empty()) throw InputError("body '" + scene.bodies[b].name + "' has no grain");
    std::vector<Vec<D>> place = in_one_piece<D>(sample, member);
    if (turns(scene.bodies[b])) check_reach<D>(scene.bodies[b], sample, member, place);
    const RigidBody<D> body = make_body<D>(scene.bodies[b], sample, member, place);
    const Mat<D> rotation = rotation_of(body);
    for (std::size_t k = 0; k < member.size(); ++k) {
      bodies.offset[member[k]] = rotation.transpose() * place[k];
      const double inverse = mean_inverse_mass<D>(body, place[k]);
      bodies.contact_mass[member[k]] = inverse > 0 ? 1 / inverse : std::numeric_limits<double>::infinity();
    }
    bodies.body.push_back(body);
    bodies.any_turning = bodies.any_turning || body.turns;
    bodies.member.insert(bodies.member.end(), member.begin(), member.end());
    bodies.first.push_back(static_cast<int>(bodies.member.size()));
  }
  return bodies;
}

template <int D>
void move_with_bodies(const Scene& scene, Sample<D>& sample) {
  const RigidBodies<D> bodies = rigid_bodies<D>(scene, sample);
  for (std::size_t b = 0; b < bodies.body.size(); ++b) {
    const RigidBody<D>& body = bodies.body[b];
    const Mat<D> rotation = rotation_of(body);
    for (int k = bodies.first[b]; k < bodies.first[b + 1]; ++k) {
      const int grain = bodies.member[k];
      sample.velocity[grain] = body.velocity + cross(body.spin, Vec<D>(rotation * bodies.offset[grain]));
      sample.spin[grain] = body.spin;
    }
  }
}

std::vector<int> contact_groups(const Scene& scene, const std::vector<int>& body_of) {
  std::vector<int> group = body_of;
  for (int& body : group)
    if (body >= 0) body -= scene.bodies[body].segment;
  return group;
}

bool any_turning(const Scene& scene) { return std::any_of(scene.bodies.begin(), scene.bodies.end(), turns); }

template RigidBodies<2> rigid_bodies<2>(const Scene&, const Sample<2>&);
template RigidBodies<3> rigid_bodies<3>(const Scene&, const Sample<3>&);
template void move_with_bodies<2>(const Scene&, Sample<2>&);
template void move_with_bodies<3>(const Scene&, Sample<3>&);

}  // namespace galet
