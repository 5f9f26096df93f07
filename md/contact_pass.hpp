// Contact pass: one force per listed pair, from positions and the velocities that contacts see.
//
// Each row is written by its own iteration only; sums over contacts (the contact part of V sigma) are kept per chunk
// and added in the order of the chunks. So the result has the same bits for any number of threads.
#pragma once

#include "common/core/parallel.hpp"
#include "common/engine/bodies.hpp"
#include "common/geometry/contact_frame.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "md/contacts.hpp"
#include "md/laws/normal_linear.hpp"
#include "md/laws/tangential_linear.hpp"

namespace galet::md {

/// What contacts see of the motion: velocities predicted for the time of the positions.
template <Layout Y>
struct Seen {
  Column<Vec<Y.dim>> velocity;
  Column<Spin<Y.dim>, Y.friction> spin;
  Mat<Y.dim> gradient = Mat<Y.dim>::Zero();  ///< L
};

/// The law's constants for one pass.
struct PassLaw {
  double normal_stiffness;
  DampingConvention convention;
  TangentialLaw tangential;
  double dt;  ///< time since the last pass (transport of histories)
};

template <Layout Y>
class ContactPass {
 public:
  static constexpr int D = Y.dim;

  /// Writes the rows of `contacts`; returns the contact part of V sigma, sum of F (x) b.
  Mat<D> run(const Bodies<Y>& bodies, const Seen<Y>& seen, const VerletList<D>& list, const PassLaw& law,
             Contacts<Y>& contacts) {
    const std::size_t rows = list.size();
    refill(partial_virial_, chunk_count(rows), Mat<D>::Zero());
    parallel_chunks(rows, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      Mat<D> virial = Mat<D>::Zero();
      for (std::size_t row = begin; row < end; ++row) row_force(bodies, seen, list, law, row, contacts, virial);
      partial_virial_[chunk] = virial;
    });
    Mat<D> virial = Mat<D>::Zero();
    for (const Mat<D>& part : partial_virial_) virial += part;
    return virial;
  }

 private:
  static void clear(Contacts<Y>& contacts, std::size_t row) {
    if (!contacts.touching[row]) return;  // already zero
    contacts.touching[row] = 0;
    contacts.force[row].setZero();
    if constexpr (Y.friction) contacts.twist[row] = zero_spin<D>(), contacts.spring[row] = zero_spin<D>();
  }

  static void row_force(const Bodies<Y>& bodies, const Seen<Y>& seen, const VerletList<D>& list, const PassLaw& law,
                        std::size_t row, Contacts<Y>& contacts, Mat<D>& virial) {
    const PairColumns<D>& pairs = list.pairs();
    const int i = pairs.i[row], j = pairs.j[row], grains = bodies.grains();
    if (j < grains) {
      const Vec<D> branch = bodies.position[j] - bodies.position[i] + lattice<D>(bodies.cell.box, pairs.image[row]);
      const double distance_squared = branch.squaredNorm();
      const double reach = bodies.radius[i] + bodies.radius[j];
      if (distance_squared >= reach * reach) return clear(contacts, row);
      const auto frame = grain_frame<D>(branch, distance_squared, bodies.radius[i], bodies.radius[j]);
      const Vec<D> closing = seen.velocity[j] - seen.velocity[i] + seen.gradient * branch;
      touch(bodies, seen, law, frame, closing, i, j, row, contacts);
      virial += contacts.force[row] * branch.transpose();
    } else {
      const Plane<D>& plane = bodies.planes[j - grains];
      const auto frame = plane_frame<D>(bodies.position[i], bodies.radius[i], plane);
      if (frame.gap >= 0) return clear(contacts, row);
      const Vec<D> closing = plane.velocity - seen.velocity[i] - seen.gradient * bodies.position[i];
      touch(bodies, seen, law, frame, closing, i, j, row, contacts);
      virial += contacts.force[row] * frame.branch.transpose();
    }
  }

  /// Applies the law to a touching pair; `centres` is the relative velocity of the centres.
  static void touch(const Bodies<Y>& bodies, const Seen<Y>& seen, const PassLaw& law, const ContactFrame<D>& frame,
                    const Vec<D>& centres, int i, int j, std::size_t row, Contacts<Y>& contacts) {
    const double opening = frame.normal.dot(centres);
    const NormalForce normal =
        normal_linear(law.normal_stiffness, contacts.damping[row], law.convention, -frame.gap, opening);
    Vec<D> force = normal.force * frame.normal;
    if constexpr (Y.friction) {
      const bool grain_j = j < bodies.grains();
      // l_i w_i + l_j w_j with l = stretch R.
      Spin<D> rolling = bodies.radius[i] * seen.spin[i];
      if (grain_j) rolling += bodies.radius[j] * seen.spin[j];
      rolling *= frame.stretch;
      if constexpr (D == 2) {
        const Vec<2> along = tangent(frame.normal);
        const double slip = along.dot(centres) - rolling;
        const double tangential = tangential_linear(law.tangential, normal.bound, slip, contacts.spring[row]);
        force += tangential * along;
        contacts.twist[row] = frame.stretch * tangential;
      } else {
        const Vec<3> slip = centres - opening * frame.normal - rolling.cross(frame.normal);
        Vec<3>& spring = contacts.spring[row];
        if (contacts.touching[row]) {
          const Vec<3> spins = grain_j ? Vec<3>(seen.spin[i] + seen.spin[j]) : seen.spin[i];
          const double twist = 0.5 * spins.dot(frame.normal) * law.dt;
          spring = transport(spring, contacts.normal[row], frame.normal, twist);
        }
        contacts.normal[row] = frame.normal;
        const Vec<3> tangential = tangential_linear(law.tangential, normal.bound, slip, spring);
        force += tangential;
        contacts.twist[row] = frame.stretch * frame.normal.cross(tangential);
      }
    }
    contacts.touching[row] = 1;
    contacts.force[row] = force;
  }

  std::vector<Mat<D>> partial_virial_;
};

}  // namespace galet::md
