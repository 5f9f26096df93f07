#include "src/restart.hpp"

#include <algorithm>
#include <string>

#include "common/core/archive_columns.hpp"
#include "common/core/error.hpp"
#include "src/engines.hpp"

namespace galet {

namespace {

const std::string& text(const Archive& archive, const std::string& name) {
  const auto found = archive.texts.find(name);
  if (found == archive.texts.end()) throw InputError("the checkpoint has no text '" + name + "'");
  return found->second;
}

template <int D>
void put_matrix(Archive& archive, const std::string& name, const Mat<D>& matrix) {
  archive.reals[name].assign(matrix.data(), matrix.data() + D * D);
}

template <int D>
void take_matrix(const Archive& archive, const std::string& name, Mat<D>& matrix) {
  const std::vector<double>& stored = real_column(archive, name);
  if (stored.size() != D * D) throw InputError("the checkpoint is of another dimension than its scene");
  matrix = Eigen::Map<const Mat<D>>(stored.data());
}

}  // namespace

void save_scene(Archive& archive, const Scene& scene, EngineKind kind, const std::vector<Override>& overrides) {
  archive.texts["engine"] = engine_name(kind);
  archive.texts["scene"] = scene.source;
  archive.texts["scene.title"] = scene.title;
  archive.texts["scene.directory"] = scene.directory;
  std::string lines;
  for (const Override& change : overrides) lines += change.path + "=" + change.value + "\n";
  archive.texts["scene.overrides"] = lines;
}

std::vector<Override> stored_overrides(const Archive& archive) {
  const std::string& lines = text(archive, "scene.overrides");
  std::vector<Override> overrides;
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', begin), lines.size());
    const std::size_t equals = lines.find('=', begin);
    if (equals >= end) throw InputError("the checkpoint's scene changes are damaged");
    overrides.push_back({lines.substr(begin, equals - begin), lines.substr(equals + 1, end - equals - 1)});
    begin = end + 1;
  }
  return overrides;
}

EngineKind stored_engine(const Archive& archive) { return engine_kind(text(archive, "engine")); }

Scene stored_scene(const Archive& archive, const std::vector<Override>& more) {
  if (text(archive, "scene").empty())
    throw InputError("the checkpoint holds no scene text: it was written by a program, which alone can resume it");
  std::vector<Mistake> mistakes;
  for (const Override& change : more)
    if (change.path.rfind("run.", 0) != 0 && change.path.rfind("output.", 0) != 0 &&
        change.path.rfind("guard.", 0) != 0)
      mistakes.push_back(
          {"", 0, 0,
           "--set " + change.path + ": a resumed run keeps its scene; only run.*, output.* and guard.* may change"});
  if (!mistakes.empty()) throw InputError(mistakes);

  std::vector<Override> overrides = stored_overrides(archive);
  overrides.insert(overrides.end(), more.begin(), more.end());
  Scene scene = parse_scene(text(archive, "scene"), "scene in the checkpoint", overrides);
  scene.directory = text(archive, "scene.directory");
  return scene;
}

namespace {

[[noreturn]] void refuse_contacts(const std::string& why) {
  throw InputError("initial.file: the checkpoint's contacts can't be kept: " + why +
                   "; set initial.contacts = \"fresh\" to take over only its grains and cell");
}

/// The columns that belong to the grains and to what their contacts remember, and not to the loading or the clock.
bool kept(const std::string& name) {
  if (name == "md.acceleration.modes") return false;
  for (const char* start :
       {"grains.", "contacts.", "neighbours.", "md.acceleration.", "md.acceleration_expected.", "md.order"})
    if (name.starts_with(start)) return true;
  return name == "md.list_age" || name == "cell.box" || name == "cell.rate";
}

template <class Columns>
void take_kept(Columns& fresh, const Columns& state) {
  for (const auto& [name, column] : state)
    if (kept(name) && !fresh.contains(name)) refuse_contacts("they are of other laws (column '" + name + "')");
  for (auto& [name, column] : fresh) {
    if (!kept(name)) continue;
    const auto found = state.find(name);
    if (found == state.end()) refuse_contacts("they are of other laws (no column '" + name + "')");
    column = found->second;
  }
}

}  // namespace

Archive with_contacts_of(Archive fresh, EngineKind kind, const Archive& state) {
  if (stored_engine(state) != kind)
    refuse_contacts("they are of engine " + engine_name(stored_engine(state)) + ", the run is of engine " +
                    engine_name(kind));
  if (integer_column(state, "layout") != integer_column(fresh, "layout"))
    refuse_contacts("they are of materials with other friction or rolling resistance (another layout)");
  if (real_column(state, "planes.point").size() != real_column(fresh, "planes.point").size())
    refuse_contacts("the scene has another number of planes");
  if (real_column(state, "neighbours.reference").at(0) != real_column(fresh, "neighbours.reference").at(0))
    refuse_contacts("the scene has another cohesion range");
  take_kept(fresh.reals, state.reals);
  take_kept(fresh.integers, state.integers);
  if (kind == EngineKind::cd) {
    // The impulses belong to the length of the last step.
    std::vector<double>& numbers = fresh.reals.at("cd.numbers");
    const std::vector<double>& stored = real_column(state, "cd.numbers");
    numbers.at(1) = stored.at(1), numbers.at(2) = stored.at(2);
  }
  return fresh;
}

template <int D>
void save_sample(Archive& archive, const Sample<D>& sample) {
  put_matrix<D>(archive, "sample.box", sample.cell.box);
  put_matrix<D>(archive, "sample.rate", sample.cell.rate);
  archive.integers["sample.periodic"].assign(sample.cell.periodic.begin(), sample.cell.periodic.end());
  std::vector<Vec<D>> planes;
  for (const Plane<D>& plane : sample.planes) planes.insert(planes.end(), {plane.point, plane.normal, plane.velocity});
  put_column(archive, "sample.planes", planes);
  std::vector<Vec<2>> drives;
  for (const Plane<D>& plane : sample.planes) drives.emplace_back(plane.inverse_mass, plane.force);
  put_column(archive, "sample.plane_drive", drives);
  std::vector<Vec<2>> shape;
  std::vector<Vec<D>> axis;
  std::vector<Spin<D>> turning;
  for (const Plane<D>& plane : sample.planes) {
    shape.emplace_back(plane.radius, plane.inside ? 1 : 0);
    axis.push_back(plane.axis), turning.push_back(plane.spin);
  }
  put_column(archive, "sample.cylinder", shape);
  put_column(archive, "sample.cylinder_axis", axis);
  put_column(archive, "sample.cylinder_spin", turning);
  put_column(archive, "sample.position", sample.position);
  put_column(archive, "sample.velocity", sample.velocity);
  put_column(archive, "sample.spin", sample.spin);
  put_column(archive, "sample.radius", sample.radius);
  put_column(archive, "sample.mass", sample.mass);
  archive.integers["sample.material"].assign(sample.material.begin(), sample.material.end());
  archive.integers["sample.body"].assign(sample.body.begin(), sample.body.end());
  archive.integers["sample.plane_material"].assign(sample.plane_material.begin(), sample.plane_material.end());
}

template <int D>
Sample<D> stored_sample(const Archive& archive) {
  Sample<D> sample;
  sample.resize(static_cast<int>(real_column(archive, "sample.radius").size()));
  take_matrix<D>(archive, "sample.box", sample.cell.box);
  take_matrix<D>(archive, "sample.rate", sample.cell.rate);
  const auto& periodic = integer_column(archive, "sample.periodic");
  if (periodic.size() != D) throw InputError("the checkpoint is of another dimension than its scene");
  for (int a = 0; a < D; ++a) sample.cell.periodic[a] = periodic[a] != 0;

  std::vector<Vec<D>> planes(real_column(archive, "sample.planes").size() / D);
  take_column(archive, "sample.planes", planes);
  for (std::size_t k = 0; k + 2 < planes.size(); k += 3)
    sample.planes.push_back({planes[k], planes[k + 1], planes[k + 2]});
  std::vector<Vec<2>> drives(sample.planes.size());
  take_column(archive, "sample.plane_drive", drives);
  for (std::size_t k = 0; k < drives.size(); ++k)
    sample.planes[k].inverse_mass = drives[k][0], sample.planes[k].force = drives[k][1];
  std::vector<Vec<2>> shape(sample.planes.size());
  std::vector<Vec<D>> axis(sample.planes.size());
  std::vector<Spin<D>> turning(sample.planes.size(), zero_spin<D>());
  take_column(archive, "sample.cylinder", shape);
  take_column(archive, "sample.cylinder_axis", axis);
  take_column(archive, "sample.cylinder_spin", turning);
  for (std::size_t k = 0; k < shape.size(); ++k) {
    sample.planes[k].radius = shape[k][0], sample.planes[k].inside = shape[k][1] != 0;
    sample.planes[k].axis = axis[k], sample.planes[k].spin = turning[k];
  }
  take_column(archive, "sample.position", sample.position);
  take_column(archive, "sample.velocity", sample.velocity);
  take_column(archive, "sample.spin", sample.spin);
  take_column(archive, "sample.radius", sample.radius);
  take_column(archive, "sample.mass", sample.mass);
  const auto& material = integer_column(archive, "sample.material");
  sample.material.assign(material.begin(), material.end());
  sample.material.resize(sample.count(), 0);
  const auto& plane_material = integer_column(archive, "sample.plane_material");
  sample.plane_material.assign(plane_material.begin(), plane_material.end());
  const auto& body = integer_column(archive, "sample.body");
  sample.body.assign(body.begin(), body.end());
  return sample;
}

template void save_sample<2>(Archive&, const Sample<2>&);
template void save_sample<3>(Archive&, const Sample<3>&);
template Sample<2> stored_sample<2>(const Archive&);
template Sample<3> stored_sample<3>(const Archive&);

}  // namespace galet
