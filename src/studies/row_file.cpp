#include "src/studies/row_file.hpp"

#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/core/archive.hpp"
#include "common/io/files.hpp"
#include "src/engines.hpp"

namespace galet {

namespace {

using Json = nlohmann::ordered_json;

std::string path_of(const std::string& directory, const StudyRun& run) {
  return (std::filesystem::path(directory) / "rows" / (run.name + ".json")).string();
}

/// JSON has no NaN: null stands for it.
double number(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

Measurement measurement(const Json& json) {
  Measurement values;
  values.values.fill(std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < observable_count; ++k) {
    const std::string name(observable_table[k].name);
    if (json.contains(name)) values.values[k] = number(json[name]);
  }
  return values;
}

Ending ending_called(const std::string& name) {
  for (const Ending ending : {Ending::equilibrium, Ending::reached, Ending::interrupted, Ending::failed})
    if (to_string(ending) == name) return ending;
  return Ending::finished;
}

Averages averages_in(const Json& json) {
  Averages averages;
  averages.from = json.at("from_time");
  averages.rows = json.at("rows");
  averages.values.fill({std::numeric_limits<double>::quiet_NaN(), 0});
  for (int k = 0; k < observable_count; ++k) {
    const std::string name(observable_table[k].name);
    if (json.contains(name)) averages.values[k] = {number(json[name].at("value")), number(json[name].at("error"))};
  }
  return averages;
}

/// Columns by observable; the values of each row.
Json series_json(const TimeSeries& series) {
  Json json = Json::object();
  for (int k = 0; k < observable_count; ++k) {
    if (!shown(static_cast<Observable>(k), series)) continue;
    Json column = Json::array();
    for (const Measurement& row : series.rows) column.push_back(row.values[k]);
    json[std::string(observable_table[k].name)] = column;
  }
  return json;
}

TimeSeries series_in(const Json& json) {
  TimeSeries series;
  for (int k = 0; k < observable_count; ++k) {
    const std::string name(observable_table[k].name);
    if (!json.contains(name)) continue;
    Measurement empty;
    empty.values.fill(std::numeric_limits<double>::quiet_NaN());
    series.rows.resize(json[name].size(), empty);
    for (std::size_t row = 0; row < series.rows.size(); ++row) series.rows[row].values[k] = number(json[name][row]);
  }
  return series;
}

/// An array of numbers per layer or ring: position, grains, velocity, shear rate, fluctuation, temperature, Phi,
/// stress.
Json profile_json(const std::vector<ProfileRow>& profile) {
  Json json = Json::array();
  for (const ProfileRow& row : profile) {
    Json cells{row.position, row.grains};
    for (const Vec<3>& vector : {row.velocity, row.shear_rate})
      for (int a = 0; a < 3; ++a) cells.push_back(vector[a]);
    for (const double value : {row.fluctuation, row.temperature, row.solid_fraction}) cells.push_back(value);
    for (int k = 0; k < 9; ++k) cells.push_back(row.stress(k / 3, k % 3));
    json.push_back(cells);
  }
  return json;
}

std::vector<ProfileRow> profile_in(const Json& json) {
  std::vector<ProfileRow> profile;
  for (const Json& cells : json) {
    std::size_t next = 0;
    const auto read = [&] { return number(cells.at(next++)); };
    ProfileRow row;
    row.position = read(), row.grains = static_cast<int>(read());
    for (Vec<3>* vector : {&row.velocity, &row.shear_rate})
      for (int a = 0; a < 3; ++a) (*vector)[a] = read();
    row.fluctuation = read(), row.temperature = read(), row.solid_fraction = read();
    for (int k = 0; k < 9; ++k) row.stress(k / 3, k % 3) = read();
    profile.push_back(row);
  }
  return profile;
}

RunResult run_in(const Json& json) {
  RunResult run;
  run.engine = engine_kind(json.at("engine"));
  run.ending = ending_called(json.at("ending"));
  run.dt = number(json.at("dt"));
  run.steps = json.at("steps");
  run.time = number(json.at("time"));
  run.strain = number(json.at("strain"));
  run.averages = averages_in(json.at("averages"));
  run.last = measurement(json.at("last"));
  if (json.contains("stages"))
    for (const Json& stage : json["stages"])
      run.stages.push_back({stage.at("name"), ending_called(stage.at("ending")), number(stage.at("time")),
                            stage.at("steps"), measurement(stage.at("last"))});
  if (!json.at("solver").is_null()) {
    run.solver.steps = json["solver"].at("steps");
    run.solver.missed = json["solver"].at("missed");
  }
  run.cpu_seconds = number(json.at("seconds"));
  run.notes = json.at("notes").get<std::vector<std::string>>();
  run.state_hash = std::stoull(json.at("state_hash").get<std::string>(), nullptr, 16);
  return run;
}

}  // namespace

std::string scene_hash(const StudyRun& run) {
  Archive archive;
  archive.integers[engine_name(run.engine)] = {run.scene.begin(), run.scene.end()};
  return fmt::format("{:016x}", state_hash(archive));
}

void write_row(const std::string& directory, const StudyRow& row) {
  Json json{{"name", row.plan.name}, {"scene_hash", scene_hash(row.plan)}, {"parameters", Json::object()}};
  for (const auto& [name, value] : row.plan.parameters) json["parameters"][name] = value;
  json["run"] = Json::parse(to_json(row.run, row.plan.name));
  if (row.plan.keep_series) json["series"] = series_json(row.run.series);
  if (row.plan.keep_profile) json["profile"] = profile_json(row.run.measures.profile);
  std::filesystem::create_directories(std::filesystem::path(directory) / "rows");
  write_file(path_of(directory, row.plan), json.dump(1) + "\n");
}

std::optional<StudyRow> read_row(const std::string& directory, const StudyRun& run) {
  const std::string path = path_of(directory, run);
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    const Json json = Json::parse(read_file(path));
    if (json.at("scene_hash") != scene_hash(run)) return std::nullopt;
    if (run.keep_series && !json.contains("series")) return std::nullopt;
    if (run.keep_profile && !json.contains("profile")) return std::nullopt;
    StudyRow row{run, run_in(json.at("run")), true};
    if (run.keep_series) row.run.series = series_in(json["series"]);
    if (run.keep_profile) row.run.measures.profile = profile_in(json["profile"]);
    if (!row.usable()) return std::nullopt;
    return row;
  } catch (const Json::exception&) {
    return std::nullopt;  // a file that somebody has edited: the run is made again
  }
}

}  // namespace galet
