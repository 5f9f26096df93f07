// Contact pass: one force per listed pair, from positions and the velocities that contacts see. The work itself is
// done by the kernels (kernel/); here it is cut into chunks.
//
// Each row is written by its own iteration only; sums over contacts (the contact part of V sigma, powers) are kept per
// chunk and added in the order of the chunks. So the result has the same bits for any number of threads.
#pragma once

#include <span>

#include "common/core/parallel.hpp"
#include "common/engine/bodies.hpp"
#include "md/contacts.hpp"
#include "md/grain_records.hpp"
#include "md/kernel/dispatch.hpp"

namespace galet::md {

/// The laws of one pass.
struct PassLaw {
  std::span<const PairTerms<double>> terms;  ///< by pair of materials
  LawKind kind;
  double range;        ///< largest D0
  double half_before;  ///< half the time since the last pass (0 at the very start)
  double half_after;   ///< half the time to the next one
  bool virial;         ///< whether PassSums::virial is wanted
};

/// Powers that contacts take out of the motion.
struct Loss {
  double viscous = 0;
  double plastic = 0;    ///< by the slider
  double unloading = 0;  ///< by a change of the stiffness
};

/// Sums over the contacts of one pass.
template <int D>
struct PassSums {
  Mat<D> virial = Mat<D>::Zero();  ///< contact part of V sigma, sum of F (x) b
  Loss normal, sliding, rolling, pivoting;
  double plane_power = 0;  ///< of moving planes on the grains

  void add(const LaneSums& lanes) {
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) virial(a, b) += sum(lanes.virial[D * a + b]);
    normal.viscous += sum(lanes.normal_viscous);
    add(sliding, lanes.sliding), add(rolling, lanes.rolling), add(pivoting, lanes.pivoting);
  }

 private:
  static double sum(const double (&lanes)[block_rows]) {
    double total = 0;
    for (const double lane : lanes) total += lane;
    return total;
  }
  static void add(Loss& to, const double (&from)[3][block_rows]) {
    to.viscous += sum(from[0]), to.plastic += sum(from[1]), to.unloading += sum(from[2]);
  }
};

template <Layout Y>
class ContactPass {
 public:
  static constexpr int D = Y.dim;

  explicit ContactPass(Kernel kernel)
      : instructions_(galet::instructions()), kernel_(kernel), function_(pass_function<Y>(instructions_, kernel)) {
    shifts_.reserve(64);  // as many images as a usual cell has
  }

  Instructions instructions() const { return instructions_; }

  /// Writes the rows of `contacts`.
  PassSums<D> run(const Bodies<Y>& bodies, Seen<Y>& seen, const PassLaw& law, Contacts<Y>& contacts) {
    constexpr std::size_t chunk = chunk_size / block_rows;
    const std::size_t blocks = contacts.block_count(), chunks = (blocks + chunk - 1) / chunk;
    const PassView view = begin(bodies, seen, law, contacts);
    const bool sums_wanted = law.virial || kernel_.account;
    refill(partial_, sums_wanted ? chunks : 1, LaneSums{});
    parallel_ranges(
        chunks,
        [&](std::size_t first, std::size_t last) {
          if (!sums_wanted) return function_(view, first * chunk, std::min(blocks, last * chunk), partial_[0]);
          for (std::size_t part = first; part < last; ++part)
            function_(view, part * chunk, std::min(blocks, (part + 1) * chunk), partial_[part]);
        },
        2);
    PassSums<D> sums;
    if (sums_wanted)
      for (const LaneSums& part : partial_) sums.add(part);
    if (kernel_.account)
      for (const PlaneRow& row : contacts.plane_rows())
        sums.plane_power -= contacts.force(row.row).dot(
            tangent_plane<D>(bodies.planes[row.plane], seen.grains.position(row.grain)).velocity);
    return sums;
  }

  /// For evaluate: what the kernel works on, with all that rows refer to in its place.
  PassView begin(const Bodies<Y>& bodies, Seen<Y>& seen, const PassLaw& law, Contacts<Y>& contacts) {
    place_planes(bodies, seen, contacts);
    return view_of(bodies, seen, law, contacts);
  }
  /// The blocks [first, last), where no sums are wanted.
  void evaluate(const PassView& view, std::size_t first, std::size_t last) const {
    LaneSums unused;
    function_(view, first, last, unused);
  }

 private:
  /// The records of the planes' points next to the grains. A pair of records moves with v_j - v_i + L b: with
  /// V - L x_j for v_j that is the velocity of the plane at x_j less that of the grain.
  void place_planes(const Bodies<Y>& bodies, Seen<Y>& seen, const Contacts<Y>& contacts) {
    const std::vector<PlaneRow>& rows = contacts.plane_rows();
    parallel_ranges(rows.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const Vec<D> grain = seen.grains.position(rows[k].grain);
        const Plane<D> plane = tangent_plane<D>(bodies.planes[rows[k].plane], grain);
        const Vec<D> foot = grain - (grain - plane.point).dot(plane.normal) * plane.normal;
        seen.grains.put_position(rows[k].record, foot);
        seen.grains.put_velocity(rows[k].record, plane.velocity - seen.gradient * foot);
      }
    });
  }

  PassView view_of(const Bodies<Y>& bodies, const Seen<Y>& seen, const PassLaw& law, Contacts<Y>& contacts) {
    refill(shifts_, (contacts.images().size() + 1) / 2, Line{});
    for (std::size_t k = 0; k < contacts.images().size(); ++k) {
      const Vec<D> shift = lattice<D>(bodies.cell.box, contacts.images()[k]);
      for (int a = 0; a < D; ++a) shifts_[k / 2].value[k % 2 * 4 + a] = shift[a];
    }
    PassView view{};
    view.records = seen.grains.data();
    view.shifts = doubles(shifts_);
    view.blocks = contacts.blocks();
    view.constants = contacts.constants();
    view.constants_stride = contacts.equal_pairs() ? 0 : 1;
    view.columns = contacts.columns();
    view.column_count = contacts.column_count();
    view.out = contacts.out();
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) view.gradient[D * a + b] = seen.gradient(a, b);
    for (int b = 0; b < D; ++b)
      if (!seen.gradient.col(b).isZero(0)) view.columns_used |= 1u << b;
    view.virial = law.virial;
    view.stepping = law.half_before > 0;
    view.half_before = law.half_before, view.half_after = law.half_after;
    view.range = law.range;
    view.kind = law.kind;
    view.terms = law.terms.data();
    view.laws = static_cast<int>(law.terms.size());
    return view;
  }

  Instructions instructions_;
  Kernel kernel_;
  PassFunction function_;
  std::vector<LaneSums> partial_;
  StepArray<Line> shifts_;
};

}  // namespace galet::md
