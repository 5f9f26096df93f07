#include "cd/discrete/fclib.hpp"

#include <limits>
#include <stdexcept>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/hdf5_tree.hpp"

namespace galet::cd {

namespace {

using Columns = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

/// The datasets of one file, and its name for messages.
class Reader {
 public:
  explicit Reader(const std::string& path)
      : path_(path),
        archive_(read_hdf5(path, {"fclib_local", "fclib_global", "fclib_global_rolling", "solution", "galet"})) {}

  [[noreturn]] void refuse(const std::string& message) const { throw InputError({Mistake{path_, 0, 0, message}}); }

  bool has(const std::string& name) const { return archive_.reals.contains(name) || archive_.integers.contains(name); }
  bool has_group(const std::string& group) const {
    return begins(archive_.reals, group) || begins(archive_.integers, group) || begins(archive_.texts, group);
  }

  const std::vector<double>& reals(const std::string& name) const {
    return column(archive_.reals, name, "real numbers");
  }
  const std::vector<std::int64_t>& integers(const std::string& name) const {
    return column(archive_.integers, name, "integers");
  }
  const std::vector<double>& reals(const std::string& name, std::size_t count, const std::string& why) const {
    const auto& values = reals(name);
    if (values.size() != count)
      refuse(fmt::format("dataset '{}' has {} values: expected {} ({})", name, values.size(), count, why));
    return values;
  }
  std::int64_t integer(const std::string& name) const {
    const auto& values = integers(name);
    if (values.size() != 1) refuse(fmt::format("dataset '{}' has {} values: expected 1", name, values.size()));
    return values[0];
  }
  std::string text(const std::string& name) const {
    const auto found = archive_.texts.find(name);
    return found == archive_.texts.end() ? "" : found->second;
  }

 private:
  template <class Map>
  static bool begins(const Map& map, const std::string& group) {
    const auto first = map.lower_bound(group + "/");
    return first != map.end() && first->first.starts_with(group + "/");
  }
  template <class Map>
  const typename Map::mapped_type& column(const Map& map, const std::string& name, const char* kind) const {
    const auto found = map.find(name);
    if (found != map.end()) return found->second;
    refuse(fmt::format("dataset '{}' {}: expected {}", name,
                       has(name) || archive_.texts.contains(name) ? "has another type" : "is missing", kind));
  }

  std::string path_;
  Archive archive_;
};

// ---- Matrices ----

int matrix_size(const Reader& reader, const std::string& name) {
  const std::int64_t size = reader.integer(name);
  if (size < 0 || size > std::numeric_limits<int>::max() - 1)
    reader.refuse(fmt::format("dataset '{}' is {}: expected a size of a matrix", name, size));
  return static_cast<int>(size);
}

void need_at_least(const Reader& reader, const std::string& name, std::size_t size, std::size_t needed) {
  if (size < needed) reader.refuse(fmt::format("dataset '{}' has {} values: expected {}", name, size, needed));
}

int index_below(const Reader& reader, const std::string& name, std::int64_t index, int bound) {
  if (index < 0 || index >= bound)
    reader.refuse(fmt::format("dataset '{}' holds the index {}: expected 0 to {}", name, index, bound - 1));
  return static_cast<int>(index);
}

/// `along` rows or columns by their compressed form, each with indices below `across`; take(line, index, value).
template <class Take>
void read_compressed(const Reader& reader, const std::string& name, int along, int across, const Take& take) {
  const auto& begin = reader.integers(name + "/p");
  const auto& index = reader.integers(name + "/i");
  const auto& value = reader.reals(name + "/x");
  need_at_least(reader, name + "/p", begin.size(), static_cast<std::size_t>(along) + 1);
  if (begin[0] != 0) reader.refuse(fmt::format("dataset '{}/p' begins with {}: expected 0", name, begin[0]));
  for (int line = 0; line < along; ++line) {
    if (begin[line + 1] < begin[line])
      reader.refuse(fmt::format("dataset '{}/p' falls at {}: expected ascending places", name, line + 1));
    need_at_least(reader, name + "/i", index.size(), static_cast<std::size_t>(begin[line + 1]));
    need_at_least(reader, name + "/x", value.size(), static_cast<std::size_t>(begin[line + 1]));
    for (std::int64_t k = begin[line]; k < begin[line + 1]; ++k)
      take(line, index_below(reader, name + "/i", index[k], across), value[k]);
  }
}

Rows read_matrix(const Reader& reader, const std::string& name) {
  const int rows = matrix_size(reader, name + "/m"), columns = matrix_size(reader, name + "/n");
  const std::int64_t form = reader.integer(name + "/nz");
  std::vector<Eigen::Triplet<double, int>> entries;
  if (form >= 0) {
    const auto& row = reader.integers(name + "/i");
    const auto& column = reader.integers(name + "/p");
    const auto& value = reader.reals(name + "/x");
    need_at_least(reader, name + "/i", row.size(), static_cast<std::size_t>(form));
    need_at_least(reader, name + "/p", column.size(), static_cast<std::size_t>(form));
    need_at_least(reader, name + "/x", value.size(), static_cast<std::size_t>(form));
    for (std::int64_t k = 0; k < form; ++k)
      entries.emplace_back(index_below(reader, name + "/i", row[k], rows),
                           index_below(reader, name + "/p", column[k], columns), value[k]);
  } else if (form == -1) {
    read_compressed(reader, name, columns, rows,
                    [&](int column, int row, double value) { entries.emplace_back(row, column, value); });
  } else if (form == -2) {
    read_compressed(reader, name, rows, columns,
                    [&](int row, int column, double value) { entries.emplace_back(row, column, value); });
  } else {
    reader.refuse(fmt::format(
        "dataset '{}/nz' is {}: expected a number of triplets, -1 (compressed columns) or -2 (compressed rows)", name,
        form));
  }
  Rows matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// ---- Problems ----

int read_block(const Reader& reader, const std::string& form) {
  const std::int64_t block = reader.integer(form + "/spacedim");
  if (block != 2 && block != 3 && block != 5)
    reader.refuse(fmt::format("dataset '{}/spacedim' is {}: expected 2, 3 or 5 (with rolling)", form, block));
  return static_cast<int>(block);
}

template <class Problem>
void read_bounds(const Reader& reader, const std::string& form, int rows, Problem& problem) {
  if (rows % problem.block != 0)
    reader.refuse(fmt::format("'{}' has {} rows: expected a multiple of spacedim = {}", form, rows, problem.block));
  const std::size_t contacts = static_cast<std::size_t>(rows / problem.block);
  problem.mu = reader.reals(form + "/vectors/mu", contacts, "one for each contact");
  const std::string other = form + "/vectors/mu_r";
  if (problem.block == 5)
    problem.mu_r = reader.reals(reader.has(other) ? other : form + "/vectors/mur", contacts, "one for each contact");
}

void refuse_equalities(const Reader& reader, const std::string& form, std::initializer_list<const char*> matrices) {
  for (const char* matrix : matrices) {
    const std::string name = form + "/" + matrix;
    if (reader.has_group(name) && reader.integer(name + "/n") > 0)
      reader.refuse(fmt::format(
          "the problem has equality constraints ('{}'): only problems of contacts alone can be solved", name));
  }
}

void take_matrix(const Rows& w, DiscreteProblem& problem) {
  problem.start.assign(w.outerIndexPtr(), w.outerIndexPtr() + w.rows() + 1);
  problem.column.assign(w.innerIndexPtr(), w.innerIndexPtr() + w.nonZeros());
  problem.value.assign(w.valuePtr(), w.valuePtr() + w.nonZeros());
}

void read_local(const Reader& reader, DiscreteProblem& problem) {
  const std::string form = "fclib_local";
  refuse_equalities(reader, form, {"V", "R"});
  const Rows w = read_matrix(reader, form + "/W");
  if (w.rows() != w.cols())
    reader.refuse(
        fmt::format("matrix '{}/W' has {} rows and {} columns: expected a square one", form, w.rows(), w.cols()));
  const int rows = static_cast<int>(w.rows());
  read_bounds(reader, form, rows, problem);
  problem.q = reader.reals(form + "/vectors/q", static_cast<std::size_t>(rows), "one for each row of W");
  take_matrix(w, problem);
}

GlobalProblem read_global(const Reader& reader, const std::string& form) {
  refuse_equalities(reader, form, {"G"});
  GlobalProblem problem;
  problem.block = read_block(reader, form);
  const Columns mass = read_matrix(reader, form + "/M"), h = read_matrix(reader, form + "/H");
  if (mass.rows() != mass.cols() || mass.rows() != h.rows())
    reader.refuse(fmt::format("'{0}/M' is {1} x {2} and '{0}/H' {3} x {4}: expected a square M, with as many rows as H",
                              form, mass.rows(), mass.cols(), h.rows(), h.cols()));
  read_bounds(reader, form, static_cast<int>(h.cols()), problem);
  problem.w = reader.reals(form + "/vectors/w", static_cast<std::size_t>(h.cols()), "one for each column of H");
  problem.f = reader.reals(form + "/vectors/f", static_cast<std::size_t>(h.rows()), "one for each row of M");
  for (const double value : problem.f)
    if (!std::isfinite(value))
      reader.refuse(fmt::format("dataset '{}/vectors/f' holds a value that is not finite", form));
  problem.mass = mass, problem.jacobian = h;
  problem.title = reader.text(form + "/info/title");
  problem.description = reader.text(form + "/info/description");
  return problem;
}

DiscreteProblem reduced_of_file(const Reader& reader, const std::string& form, const GlobalProblem& problem) {
  try {
    return reduced(problem);
  } catch (const std::invalid_argument& error) {
    reader.refuse(fmt::format("matrix '{}/M' {}", form, error.what()));
  }
}

/// Of a problem with so many rows; left empty where the file has none.
void read_solution(const Reader& reader, std::size_t rows, std::vector<double>& u, std::vector<double>& r) {
  if (!reader.has("solution/r")) return;
  r = reader.reals("solution/r", rows, "one for each row of W");
  u = reader.reals("solution/u", rows, "one for each row of W");
}

std::optional<FclibScale> read_scale(const Reader& reader) {
  if (!reader.has_group("galet")) return std::nullopt;
  const auto positive = [&](const std::string& name) {
    const double value = reader.reals(name, 1, "a number").front();
    if (!(value > 0 && std::isfinite(value)))
      reader.refuse(fmt::format("dataset '{}' is {}: expected a number above 0", name, value));
    return value;
  };
  return FclibScale{positive("galet/gap_time"), positive("galet/diameter")};
}

void add_scale(const std::optional<FclibScale>& scale, Archive& archive) {
  if (!scale) return;
  archive.reals["galet/gap_time"] = {scale->gap_time};
  archive.reals["galet/diameter"] = {scale->diameter};
}

std::string form_of(const Reader& reader) {
  for (const char* known : {"fclib_local", "fclib_global", "fclib_global_rolling"})
    if (reader.has_group(known)) return known;
  reader.refuse("this is not an FCLIB file: expected a group 'fclib_local', 'fclib_global' or 'fclib_global_rolling'");
}

void add_matrix(Columns matrix, const std::string& name, Archive& archive) {
  matrix.makeCompressed();
  const auto integer = [&](const char* field, Eigen::Index value) { archive.integers[name + field] = {value}; };
  const auto entries = matrix.nonZeros();
  integer("/m", matrix.rows()), integer("/n", matrix.cols()), integer("/nz", -1), integer("/nzmax", entries);
  archive.integers[name + "/p"].assign(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.cols() + 1);
  archive.integers[name + "/i"].assign(matrix.innerIndexPtr(), matrix.innerIndexPtr() + entries);
  archive.reals[name + "/x"].assign(matrix.valuePtr(), matrix.valuePtr() + entries);
}

template <class Problem>
void add_rest(const Problem& problem, const std::string& form, Archive& archive) {
  archive.integers[form + "/spacedim"] = {problem.block};
  archive.reals[form + "/vectors/mu"] = problem.mu;
  archive.texts[form + "/info/title"] = problem.title;
  archive.texts[form + "/info/description"] = problem.description;
  archive.texts[form + "/info/math_info"] = "";
}

void require_solution(const std::vector<double>& u, const std::vector<double>& r, std::size_t rows) {
  require(r.size() == u.size() && (r.empty() || r.size() == rows),
          "a solution has as many numbers as the problem has rows");
}

}  // namespace

FclibContent read_fclib(const std::string& path) {
  const Reader reader(path);
  FclibContent content;
  DiscreteProblem& problem = content.problem;
  const std::string form = form_of(reader);
  if (form == "fclib_local") {
    problem.block = read_block(reader, form);
    read_local(reader, problem);
    problem.title = reader.text(form + "/info/title");
    problem.description = reader.text(form + "/info/description");
  } else {
    content.global = read_global(reader, form);
    problem = reduced_of_file(reader, form, *content.global);
  }
  content.scale = read_scale(reader);
  read_solution(reader, problem.q.size(), content.u, content.r);
  std::vector<Mistake> mistakes;
  for (const std::string& mistake : mistakes_of(problem)) mistakes.push_back({path, 0, 0, mistake});
  if (!mistakes.empty()) throw InputError(mistakes);
  return content;
}

FclibGlobalContent read_fclib_global(const std::string& path) {
  const Reader reader(path);
  const std::string form = form_of(reader);
  if (form == "fclib_local") reader.refuse("this is a problem in local form: expected one in global form");
  FclibGlobalContent content;
  content.problem = read_global(reader, form);
  read_solution(reader, content.problem.w.size(), content.u, content.r);
  content.scale = read_scale(reader);
  if (!content.r.empty()) content.v = reader.reals("solution/v", content.problem.f.size(), "one for each row of M");
  return content;
}

void write_fclib(const std::string& path, const FclibGlobalContent& content) {
  const GlobalProblem& problem = content.problem;
  const auto rows = static_cast<std::size_t>(problem.jacobian.cols());
  const auto freedoms = static_cast<std::size_t>(problem.jacobian.rows());
  require(problem.mass.rows() == problem.mass.cols() && problem.mass.rows() == problem.jacobian.rows() &&
              problem.f.size() == freedoms && problem.w.size() == rows &&
              rows == static_cast<std::size_t>(problem.block) * problem.mu.size() &&
              problem.mu_r.size() == (problem.block == 5 ? problem.mu.size() : 0),
          "a problem whose sizes don't agree is not written");
  require_solution(content.u, content.r, rows);
  require(content.v.size() == (content.r.empty() ? 0 : freedoms), "a solution has as many velocities as M has rows");
  const std::string form = problem.block == 5 ? "fclib_global_rolling" : "fclib_global";
  Archive archive;
  add_matrix(problem.mass, form + "/M", archive);
  add_matrix(problem.jacobian, form + "/H", archive);
  archive.reals[form + "/vectors/f"] = problem.f;
  archive.reals[form + "/vectors/w"] = problem.w;
  if (problem.block == 5) archive.reals[form + "/vectors/mu_r"] = problem.mu_r;
  add_rest(problem, form, archive);
  add_scale(content.scale, archive);
  if (!content.r.empty()) {
    archive.reals["solution/v"] = content.v;
    archive.reals["solution/u"] = content.u, archive.reals["solution/r"] = content.r;
  }
  write_hdf5(path, archive);
}

void write_fclib(const std::string& path, const FclibContent& content) {
  const DiscreteProblem& problem = content.problem;
  const std::vector<std::string> mistakes = mistakes_of(problem);
  require(mistakes.empty(), mistakes.empty() ? "" : "a problem with mistakes is not written: " + mistakes.front());
  require_solution(content.u, content.r, problem.q.size());
  require(problem.value.size() < static_cast<std::size_t>(std::numeric_limits<int>::max()),
          "an FCLIB file can't hold that many entries of W");
  const std::vector<int> start(problem.start.begin(), problem.start.end());
  const int rows = problem.rows(), entries = static_cast<int>(problem.value.size());
  const Columns w =
      Eigen::Map<const Rows>(rows, rows, entries, start.data(), problem.column.data(), problem.value.data());
  Archive archive;
  add_matrix(w, "fclib_local/W", archive);
  archive.reals["fclib_local/vectors/q"] = problem.q;
  if (problem.block == 5) archive.reals["fclib_local/vectors/mur"] = problem.mu_r;
  add_rest(problem, "fclib_local", archive);
  add_scale(content.scale, archive);
  if (!content.r.empty()) archive.reals["solution/u"] = content.u, archive.reals["solution/r"] = content.r;
  write_hdf5(path, archive);
}

}  // namespace galet::cd
