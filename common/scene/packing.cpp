#include "common/scene/packing.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/core/random.hpp"
#include "common/io/checkpoint_sample.hpp"
#include "common/io/lammps.hpp"
#include "common/io/packing_csv.hpp"
#include "common/scene/body_shapes.hpp"
#include "common/scene/dense_packing.hpp"
#include "common/scene/materials.hpp"
#include "common/scene/placement.hpp"
#include "common/scene/random_insertion.hpp"
#include "common/scene/rigid_bodies.hpp"
#include "common/scene/size_distribution.hpp"
#include "common/scene/spatial_order.hpp"

namespace galet {

namespace {

/// Listed grains may overlap by rounding, packings by what soft grains under load do; beyond, it is a mistake.
constexpr double listed_overlap = 1e-6, packing_overlap = 0.2;  // in units of R_i + R_j

/// A vector that the scene gives as a list; `path` is its name in the scene.
template <int D>
Vec<D> vector_of(const std::vector<double>& values, const std::string& path) {
  if (values.size() != static_cast<std::size_t>(D))
    throw InputError(fmt::format("{}: expected {} components, found {}", path, D, values.size()));
  return Eigen::Map<const Vec<D>>(values.data());
}

template <int D>
std::array<bool, D> periodicity(const Scene& scene) {
  if (scene.cell.periodic.empty()) return all_periodic<D>();
  if (scene.cell.periodic.size() != static_cast<std::size_t>(D))
    throw InputError(fmt::format("cell.periodic: expected {} values, found {}", D, scene.cell.periodic.size()));
  std::array<bool, D> periodic{};
  std::copy(scene.cell.periodic.begin(), scene.cell.periodic.end(), periodic.begin());
  return periodic;
}

template <int D>
Vec<D> positive_vector(const std::vector<double>& values, const std::string& path) {
  const Vec<D> result = vector_of<D>(values, path);
  if (!(result.minCoeff() > 0)) throw InputError(path + ": every component must be above 0");
  return result;
}

/// The cell with edges cell.size, or with the volume that gives the grains the scene's solid fraction.
template <int D>
Cell<D> initial_cell(const Scene& scene, double solid_volume) {
  Cell<D> cell;
  cell.periodic = periodicity<D>(scene);
  if (!scene.cell.size.empty()) {
    cell.box = positive_vector<D>(scene.cell.size, "cell.size").asDiagonal();
    return cell;
  }
  if (!(scene.initial.solid_fraction > 0)) throw InputError("initial.solid_fraction must be above 0");
  Vec<D> aspect = Vec<D>::Ones();
  if (!scene.cell.aspect.empty()) aspect = positive_vector<D>(scene.cell.aspect, "cell.aspect");
  const double volume = solid_volume / scene.initial.solid_fraction;
  cell.box = (aspect * std::pow(volume / aspect.prod(), 1.0 / D)).asDiagonal();
  return cell;
}

template <int D>
Plane<D> scene_cylinder(const CylinderSpec& spec, std::size_t k) {
  const std::string path = fmt::format("cylinder {}", k + 1);
  Plane<D> surface;
  surface.point = vector_of<D>(spec.point, path + ", point");
  if (!(spec.radius > 0)) throw InputError(path + ", radius: must be above 0");
  surface.radius = spec.radius, surface.inside = !spec.outside;
  if (!spec.velocity.empty()) surface.velocity = vector_of<D>(spec.velocity, path + ", velocity");
  if constexpr (D == 2) {
    surface.spin = spec.spin;
  } else {
    surface.axis = Vec<D>::Unit(static_cast<int>(spec.axis));
    surface.spin = spec.spin * surface.axis;
  }
  return surface;
}

/// Planes, and cylinders after them.
template <int D>
std::vector<Plane<D>> scene_planes(const Scene& scene) {
  std::vector<Plane<D>> planes;
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const PlaneSpec& spec = scene.planes[k];
    const std::string path = fmt::format("plane {}", k + 1);
    Plane<D> plane;
    plane.point = vector_of<D>(spec.point, path + ", point");
    plane.normal = vector_of<D>(spec.normal, path + ", normal");
    if (!(plane.normal.norm() > 0)) throw InputError(path + ", normal: must not be the zero vector");
    plane.normal.normalize();
    if (!spec.velocity.empty()) plane.velocity = vector_of<D>(spec.velocity, path + ", velocity");
    if (spec.mass) plane.inverse_mass = 1 / *spec.mass, plane.force = spec.force;
    planes.push_back(plane);
  }
  for (std::size_t k = 0; k < scene.cylinders.size(); ++k) planes.push_back(scene_cylinder<D>(scene.cylinders[k], k));
  return planes;
}

template <int D>
void set_masses(const Scene& scene, Sample<D>& sample) {
  const double mean_volume = grain_volume<D>(mean_diameter(scene, sample.radius));
  const double density = scene.grains.density.value_or(scene.grains.mass.value_or(1) / mean_volume);
  for (int i = 0; i < sample.count(); ++i) {
    const int k = sample.material[i];
    const double own = k > 0 ? scene.other_materials[k - 1].density.value_or(density) : density;
    sample.mass[i] = own * grain_volume<D>(2 * sample.radius[i]);
  }
}

template <int D>
void set_random_velocities(const Scene& scene, Sample<D>& sample) {
  Vec<D> momentum = Vec<D>::Zero();
  double mass = 0;
  for (int i = 0; i < sample.count(); ++i) {
    if (!sample.body.empty() && sample.body[i] >= 0) continue;
    RandomStream random(scene.seed, stream_number(StreamPurpose::velocity, i));
    for (int a = 0; a < D; ++a) sample.velocity[i][a] = scene.initial.speed * random.normal();
    momentum += sample.mass[i] * sample.velocity[i];
    mass += sample.mass[i];
  }
  if (mass == 0) return;  // clumps only
  for (Vec<D>& velocity : sample.velocity) velocity -= momentum / mass;
}

/// Numbers of lattice sites along the cell vectors, refined where the spacing is largest: of all lattices with at
/// least as many sites, none has a larger least spacing.
template <int D>
struct SiteCounts {
  Vec<D> size;     ///< edges of the cell
  Image<D> sites;  ///< along each edge
  explicit SiteCounts(const Vec<D>& edges) : size(edges) { sites.fill(1); }

  double spacing(int a) const { return size[a] / sites[a]; }
  double least_spacing() const {
    double least = spacing(0);
    for (int a = 1; a < D; ++a) least = std::min(least, spacing(a));
    return least;
  }
  long total() const {
    return std::accumulate(sites.begin(), sites.end(), 1L, [](long product, int k) { return product * k; });
  }
  void refine() {
    int widest = 0;
    for (int a = 1; a < D; ++a)
      if (spacing(a) > spacing(widest)) widest = a;
    ++sites[widest];
  }
};

/// The sites of a lattice where a grain of `radius` crosses no plane.
template <int D>
std::vector<Vec<D>> free_sites(const SiteCounts<D>& lattice, const std::vector<Plane<D>>& planes, double radius) {
  std::vector<Vec<D>> sites;
  for (long index = 0; index < lattice.total(); ++index) {
    Vec<D> x;
    long rest = index;
    for (int a = 0; a < D; ++a) {
      x[a] = (static_cast<double>(rest % lattice.sites[a]) + 0.5) * lattice.spacing(a);
      rest /= lattice.sites[a];
    }
    if (crossed_plane<D>(planes, x, radius) < 0) sites.push_back(x);
  }
  return sites;
}

/// A square or cubic lattice (stretched to fit the cell), each grain moved by at most 1 % of the diameter and less
/// than would let two touch. Vacant sites, when the count fills no lattice, are spread evenly.
template <int D>
void place_on_lattice(const Scene& scene, Sample<D>& sample) {
  const double diameter = 2 * *std::max_element(sample.radius.begin(), sample.radius.end());
  const std::size_t count = sample.position.size();
  SiteCounts<D> lattice(sample.cell.box.diagonal());
  std::vector<Vec<D>> sites;
  for (;; lattice.refine()) {
    if (lattice.total() < static_cast<long>(count)) continue;
    if (lattice.least_spacing() < diameter * (1 - 1e-12))
      throw InputError(fmt::format(
          "a lattice of {} grains in this cell has a spacing of {:.6g}, less than the largest diameter {:.6g}: lower "
          "initial.solid_fraction or enlarge cell.size",
          count, lattice.least_spacing(), diameter));
    sites = free_sites<D>(lattice, sample.planes, diameter / 2);
    if (sites.size() >= count) break;
  }
  const double slack = std::max(0.0, lattice.least_spacing() - diameter);
  const double shake = std::min(0.01 * diameter, 0.49 * slack / std::sqrt(D));
  for (std::size_t i = 0; i < count; ++i) {
    const Vec<D>& site = sites[i * sites.size() / count];
    RandomStream random(scene.seed, stream_number(StreamPurpose::shake, static_cast<int>(i)));
    Vec<D> moved = site;
    for (int a = 0; a < D; ++a) moved[a] += random.uniform(-shake, shake);
    // A grain close to a plane stays on its site.
    sample.position[i] = crossed_plane<D>(sample.planes, moved, sample.radius[i]) < 0 ? moved : site;
  }
}

/// Refuses grains that overlap by more than the given share of R_i + R_j (those of one body may), or that cross a plane
/// as far.
template <int D>
void refuse_overlaps(const Scene& scene, const Sample<D>& sample, double share) {
  const std::vector<int> group = contact_groups(scene, sample.body);
  const double largest = *std::max_element(sample.radius.begin(), sample.radius.end());
  const Vec<D> width = face_distances<D>(sample.cell.box);
  for (int a = 0; a < D; ++a)
    if (sample.cell.periodic[a] && width[a] < 2 * largest * (1 - share))
      throw InputError(
          fmt::format("the cell is {:.6g} wide along its vector {}: a grain of diameter {:.6g} overlaps its own image",
                      width[a], a + 1, 2 * largest));
  PlacementGrid<D> grid(sample.cell, 2 * largest, sample.count());
  for (int i = 0; i < sample.count(); ++i) {
    const auto glued = [&](int j) { return !group.empty() && group[i] >= 0 && group[j] == group[i]; };
    const int other = grid.touched(sample.position[i], sample.radius[i], 1 - share, glued);
    if (other >= 0) throw InputError(fmt::format("grains {} and {} overlap", other + 1, i + 1));
    const int plane = crossed_plane<D>(sample.planes, sample.position[i], sample.radius[i] * (1 - share));
    if (plane >= 0) {
      const auto flat = static_cast<int>(
          std::count_if(sample.planes.begin(), sample.planes.end(), [](const Plane<D>& p) { return !p.curved(); }));
      throw InputError(plane < flat ? fmt::format("grain {} crosses plane {}", i + 1, plane + 1)
                                    : fmt::format("grain {} crosses cylinder {}", i + 1, plane - flat + 1));
    }
    grid.add(sample.position[i], sample.radius[i]);
  }
}

template <int D>
void wrap_positions(Sample<D>& sample) {
  const Mat<D> inverse = sample.cell.box.inverse();
  for (Vec<D>& x : sample.position) x = wrapped_position<D>(sample.cell, inverse, x);
}

/// A gas or a dense packing, whose grains are numbered along a curve through the cell.
template <int D>
void place_at_random(const Scene& scene, Sample<D>& sample, GluedGrains<D>& glued) {
  std::vector<Plane<D>> bounds = sample.planes;
  for (const Plane<D>& bound : shape_bounds<D>(scene, sample.cell)) bounds.push_back(bound);
  // Clumps take the room of their enclosing spheres.
  const std::vector<UnplacedClump> clumps = unplaced_clumps(scene);
  std::vector<double> radii = sample.radius;
  for (const UnplacedClump& clump : clumps) radii.push_back(clump.radius);
  const auto place = scene.initial.kind == InitialKind::dense ? dense_packing<D> : random_insertion<D>;
  std::vector<Vec<D>> position = place(sample.cell, bounds, radii, scene.seed, glued);
  for (std::size_t k = 0; k < clumps.size(); ++k)
    add_clump<D>(scene, clumps[k], position[sample.position.size() + k], glued);
  position.resize(sample.position.size());
  const std::vector<int> order = spatial_order<D>(sample.cell, position);
  const std::vector<double> radius = sample.radius;
  for (int k = 0; k < sample.count(); ++k) {
    sample.position[k] = position[order[k]];
    sample.radius[k] = radius[order[k]];
  }
}

/// Index of the body of that name; -1 for no name.
int body_index(const Scene& scene, const std::string& name) {
  if (name.empty()) return -1;
  for (std::size_t k = 0; k < scene.bodies.size(); ++k)
    if (scene.bodies[k].name == name) return static_cast<int>(k);
  throw InputError("there is no body called '" + name + "'");
}

/// The grains of bodies beside drawn ones: those that are listed, and those of shapes.
template <int D>
GluedGrains<D> glued_grains(const Scene& scene, const Cell<D>& cell) {
  GluedGrains<D> glued;
  for (std::size_t k = 0; k < scene.grains.listed.size(); ++k) {
    const ListedGrain& grain = scene.grains.listed[k];
    const int body = body_index(scene, grain.body);
    if (body < 0)
      throw InputError(fmt::format("grain {}: beside drawn grains, listed ones must be glued to a body", k + 1));
    glued.add(vector_of<D>(grain.position, fmt::format("grain {}, position", k + 1)), grain.diameter / 2, body,
              material_index(scene, grain.material));
  }
  add_shapes<D>(scene, cell, glued);
  return glued;
}

/// Adds them to a sample whose other grains are complete but for their masses.
template <int D>
void append_glued(const GluedGrains<D>& glued, Sample<D>& sample) {
  if (sample.body.empty()) sample.body.assign(sample.position.size(), -1);
  sample.position.insert(sample.position.end(), glued.position.begin(), glued.position.end());
  sample.radius.insert(sample.radius.end(), glued.radius.begin(), glued.radius.end());
  sample.material.insert(sample.material.end(), glued.material.begin(), glued.material.end());
  sample.body.insert(sample.body.end(), glued.body.begin(), glued.body.end());
  sample.velocity.resize(sample.position.size(), Vec<D>::Zero());
  sample.spin.resize(sample.position.size(), zero_spin<D>());
  sample.mass.resize(sample.position.size(), 1.0);
}

/// A lattice, a gas or a dense packing; grains of bodies come last.
template <int D>
Sample<D> drawn_sample(const Scene& scene) {
  if (scene.grains.count < 1 && !any_shape(scene)) throw InputError("grains.count must be at least 1");
  Sample<D> sample;
  sample.resize(scene.grains.count);
  const std::vector<double> diameters = draw_diameters(scene, scene.grains.count);
  for (int i = 0; i < sample.count(); ++i) sample.radius[i] = diameters[i] / 2;
  sample.cell = initial_cell<D>(scene, sample.solid_volume());
  sample.planes = scene_planes<D>(scene);
  GluedGrains<D> glued = glued_grains<D>(scene, sample.cell);
  if (scene.initial.kind == InitialKind::lattice)
    place_on_lattice<D>(scene, sample);
  else
    place_at_random<D>(scene, sample, glued);
  assign_materials<D>(scene, sample);
  if (!scene.bodies.empty()) {
    append_glued<D>(glued, sample);
    wrap_positions<D>(sample);
    refuse_overlaps<D>(scene, sample, listed_overlap);
  }
  set_masses<D>(scene, sample);
  if (scene.initial.speed > 0) set_random_velocities<D>(scene, sample);
  move_with_bodies<D>(scene, sample);
  return sample;
}

template <int D>
Spin<D> spin_of(const std::vector<double>& values, const std::string& path) {
  if constexpr (D == 2) {
    if (values.size() != 1) throw InputError(fmt::format("{}: expected 1 component, found {}", path, values.size()));
    return values[0];
  } else {
    return vector_of<3>(values, path);
  }
}

/// The cell around listed grains when nothing is periodic and cell.size is not given.
template <int D>
Cell<D> enclosing_cell(const Sample<D>& sample, const std::array<bool, D>& periodic) {
  Vec<D> size = Vec<D>::Zero();
  for (int i = 0; i < sample.count(); ++i) {
    size = size.cwiseMax(sample.position[i] + Vec<D>::Constant(sample.radius[i]));
    size = size.cwiseMax(Vec<D>::Constant(2 * sample.radius[i]));
  }
  Cell<D> cell;
  cell.periodic = periodic;
  cell.box = size.asDiagonal();
  return cell;
}

template <int D>
Sample<D> listed_sample(const Scene& scene) {
  const std::vector<ListedGrain>& listed = scene.grains.listed;
  if (listed.empty()) throw InputError("initial.kind is 'listed', but the scene lists no grain");
  Sample<D> sample;
  sample.resize(static_cast<int>(listed.size()));
  for (int i = 0; i < sample.count(); ++i) {
    const std::string path = fmt::format("grain {}", i + 1);
    sample.position[i] = vector_of<D>(listed[i].position, path + ", position");
    if (!listed[i].velocity.empty()) sample.velocity[i] = vector_of<D>(listed[i].velocity, path + ", velocity");
    if (!listed[i].spin.empty()) sample.spin[i] = spin_of<D>(listed[i].spin, path + ", spin");
    if (!(listed[i].diameter > 0)) throw InputError(path + ", diameter: must be above 0");
    sample.radius[i] = listed[i].diameter / 2;
  }
  const std::array<bool, D> periodic = periodicity<D>(scene);
  const bool any_periodic = std::find(periodic.begin(), periodic.end(), true) != periodic.end();
  if (scene.cell.size.empty() && any_periodic) throw InputError("cell.size: listed grains in a periodic cell need it");
  sample.cell = scene.cell.size.empty() ? enclosing_cell<D>(sample, periodic) : initial_cell<D>(scene, 0);
  sample.planes = scene_planes<D>(scene);
  if (!scene.bodies.empty())
    for (const ListedGrain& grain : listed) sample.body.push_back(body_index(scene, grain.body));
  assign_materials<D>(scene, sample);
  if (any_shape(scene)) {
    GluedGrains<D> glued;
    add_shapes<D>(scene, sample.cell, glued);
    append_glued<D>(glued, sample);
  }
  wrap_positions<D>(sample);
  refuse_overlaps<D>(scene, sample, listed_overlap);
  set_masses<D>(scene, sample);
  move_with_bodies<D>(scene, sample);
  return sample;
}

template <int D>
PackingFile<D> read_packing(const Scene& scene, const std::filesystem::path& path) {
  if (path.extension() == ".csv") return read_packing_csv<D>(path);
  if (path.extension() == ".data") return {read_lammps_data<D>(path, periodicity<D>(scene)), true, true};
  throw InputError(fmt::format("initial.file: '{}' must end in .csv (a table) or .data (LAMMPS)", path.string()));
}

template <int D>
Sample<D> packing_sample(const Scene& scene) {
  const std::filesystem::path path = std::filesystem::path(scene.directory) / scene.initial.file;
  PackingFile<D> file = read_packing<D>(scene, path);
  Sample<D>& sample = file.sample;
  if (file.has_cell && !scene.cell.size.empty())
    throw InputError(fmt::format("cell.size: '{}' brings its own cell; remove this field", path.string()));
  if (!file.has_cell && scene.cell.size.empty())
    throw InputError(fmt::format("cell.size: needed, because '{}' has no line '# cell: ...'", path.string()));
  if (!file.has_cell) sample.cell.box = initial_cell<D>(scene, 0).box;
  if (!scene.cell.periodic.empty()) sample.cell.periodic = periodicity<D>(scene);
  sample.planes = scene_planes<D>(scene);
  wrap_positions<D>(sample);
  refuse_overlaps<D>(scene, sample, packing_overlap);
  assign_materials<D>(scene, sample);
  if (!file.has_mass || scene.grains.density || scene.grains.mass) set_masses<D>(scene, sample);
  return sample;
}

/// The state that another run has left; the scene's planes.
template <int D>
Sample<D> continued_sample(const Scene& scene) {
  Sample<D> sample = checkpoint_sample<D>(initial_checkpoint(scene));
  if (!scene.cell.periodic.empty() && sample.cell.periodic != periodicity<D>(scene))
    throw InputError("cell.periodic: the checkpoint's cell is periodic in other directions");
  sample.planes = scene_planes<D>(scene);
  assign_materials<D>(scene, sample);
  return sample;
}

}  // namespace

std::vector<double> draw_diameters(const Scene& scene, int count) {
  const SizeDistribution& sizes = scene.grains.diameter;
  if (sizes.kind == SizeKind::discrete && (sizes.diameters.empty() || sizes.fractions.size() != sizes.diameters.size()))
    throw InputError("grains.diameter: a discrete distribution needs one fraction for each of its diameters");
  std::vector<double> diameters(count);
  for (int i = 0; i < count; ++i)
    diameters[i] = diameter_at(sizes, scene.dimension,
                               RandomStream(scene.seed, stream_number(StreamPurpose::diameter, i)).uniform());
  if (count > 0 && !(*std::min_element(diameters.begin(), diameters.end()) > 0))
    throw InputError("grains.diameter: every diameter must be above 0");
  return diameters;
}

double mean_diameter(const Scene& scene, const std::vector<double>& radius) {
  const SizeDistribution& sizes = scene.grains.diameter;
  const InitialKind kind = scene.initial.kind;
  if (kind == InitialKind::listed || kind == InitialKind::packing || kind == InitialKind::checkpoint)
    return 2 * std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(radius.size());
  return mean_power(sizes, scene.dimension, 1);
}

template <int D>
Sample<D> initial_sample(const Scene& scene) {
  require(scene.dimension == D, "the scene has another dimension than the sample asked for");
  Sample<D> sample;
  switch (scene.initial.kind) {
    case InitialKind::lattice:
    case InitialKind::gas:
    case InitialKind::compressed_gas:
    case InitialKind::dense:
      return drawn_sample<D>(scene);
    case InitialKind::packing:
      sample = packing_sample<D>(scene);
      break;
    case InitialKind::listed:
      return listed_sample<D>(scene);
    case InitialKind::checkpoint:
      return continued_sample<D>(scene);
  }
  if (scene.initial.speed > 0) set_random_velocities<D>(scene, sample);
  return sample;
}

template Sample<2> initial_sample<2>(const Scene&);
template Sample<3> initial_sample<3>(const Scene&);

}  // namespace galet
