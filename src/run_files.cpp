#include "src/run_files.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "common/io/csv.hpp"
#include "common/io/files.hpp"
#include "common/io/hdf5_states.hpp"
#include "common/io/svg.hpp"
#include "src/engines.hpp"
#include "src/final_measures_json.hpp"
#include "src/picture_files.hpp"

namespace galet {

namespace {

/// mu* against strain in shear, Phi against time otherwise.
Figure history(const RunResult& result, const std::string& title) {
  const bool sheared = result.strain != 0;
  Figure figure{title, sheared ? "strain" : "time", sheared ? "mu*" : "Phi", false, false, {}};
  Series series;
  series.label = engine_name(result.engine);
  series.x = result.series.column(sheared ? Observable::strain : Observable::time);
  series.y = result.series.column(sheared ? Observable::mu_star : Observable::solid_fraction);
  series.line = true;
  if (series.x.size() > 1) figure.series.push_back(std::move(series));
  return figure;
}

}  // namespace

template <int D>
std::vector<std::string> write_run(const RunResult& result, Simulation<D>& simulation, const std::string& scene,
                                   const std::string& directory) {
  const std::string engine = engine_name(result.engine);
  const auto path = [&](const std::string& name) { return (std::filesystem::path(directory) / name).string(); };
  std::vector<std::string> files = {path(engine + "_series.csv"), path(engine + "_series.h5"),
                                    path(engine + "_summary.json")};
  const CsvTable series = to_table(result.series);
  write_csv(files[0], series);
  write_file(files[1], hdf5_table(series));
  write_file(files[2], to_json(result, scene) + "\n");
  add_figure(files, path(engine + (result.strain != 0 ? "_mu_star" : "_Phi")), history(result, scene));
  for (const NamedTable& measure : measure_tables(result.measures, simulation.scale())) {
    files.push_back(path(engine + "_" + measure.name + ".csv"));
    write_csv(files.back(), measure.table);
  }
  if constexpr (D == 2) {
    if (result.ending != Ending::failed)
      add_picture(files, path("sample_" + engine), force_chain_svg(simulation.engine().snapshot(), {.title = scene}));
  }
  return files;
}

template std::vector<std::string> write_run<2>(const RunResult&, Simulation<2>&, const std::string&,
                                               const std::string&);
template std::vector<std::string> write_run<3>(const RunResult&, Simulation<3>&, const std::string&,
                                               const std::string&);

}  // namespace galet
