// erbs record FILE: the key numbers of a ground motion, and its plot in a folder.
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>

#include "engine/base/units.h"
#include "engine/loads/record/record_report.h"
#include "engine/record/format/json.h"
#include "engine/record/plot/record_plot.h"
#include "lua/program/options.h"
#include "lua/program/say.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

Json to_json(const RecordReport& r) {
  Json spectrum = Json::array();
  for (const ResponsePoint& point : r.spectrum) spectrum.push_back({point.period, point.acceleration});
  return {{"file", r.file},
          {"hash", r.hash},
          {"title", r.title},
          {"format", r.format},
          {"corrected", r.note},
          {"points", r.points},
          {"dt_s", r.dt > 0 ? Json(r.dt) : Json(nullptr)},
          {"duration_s", r.duration},
          {"pga_m_s2", std::abs(r.pga.value)},
          {"pga_g", std::abs(r.pga.value) / standard_g},
          {"pgv_m_s", std::abs(r.pgv.value)},
          {"pgd_m", std::abs(r.pgd.value)},
          {"end_velocity_m_s", r.end_velocity},
          {"end_displacement_m", r.end_displacement},
          {"arias_m_s", r.arias},
          {"duration_5_95_s", r.time_95 - r.time_5},
          {"spectrum_s_m_s2", spectrum}};
}

// Drawing the same record again replaces its plot. A folder with other content is refused.
void check_folder(const fs::path& folder, const RecordReport& r, bool force) {
  if (!fs::exists(fs::symlink_status(folder))) return;
  const fs::path numbers = folder / "record.json";
  if (fs::is_directory(folder) && fs::is_empty(folder)) return;
  if (!fs::is_regular_file(numbers))
    throw Error(fmt::format("\"{}\" exists and is no folder of erbs record; choose another with -o DIR", folder.string()));
  if (!force && read_json(numbers.string()).value("hash", "") != r.hash)
    throw Error(fmt::format("output folder \"{}\" holds another record; choose another with -o DIR, or overwrite it with --force",
                            folder.string()));
}

fs::path folder_of(const RecordCommand& command, const std::string& file) {
  return command.output.directory.empty() ? fs::path("runs") / fs::path(file).stem() : fs::path(command.output.directory);
}

// Records of one name would be written over each other.
void check_names(const RecordCommand& command) {
  const std::vector<std::string>& files = command.words;
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const std::string folder = folder_of(command, files[i]).string(); folder == folder_of(command, files[j]))
        throw Error(fmt::format("{} would go into the folder of {}, \"{}\"; read them one at a time, each with its own -o DIR", files[i],
                                files[j], folder));
}

// The record without its corrections; none if there are none.
std::optional<Uncorrected> uncorrected(const Record& wanted) {
  if (wanted.baseline == "none" && wanted.low <= 0 && wanted.high <= 0) return std::nullopt;
  Record plain = wanted;
  plain.baseline = "none", plain.low = plain.high = 0;
  Uncorrected out{read_record(plain), {}};
  out.report = report(out.record);
  return out;
}

Json end_values(const RecordReport& r) {
  return {{"pga_m_s2", std::abs(r.pga.value)},
          {"pgv_m_s", std::abs(r.pgv.value)},
          {"pgd_m", std::abs(r.pgd.value)},
          {"end_velocity_m_s", r.end_velocity},
          {"end_displacement_m", r.end_displacement}};
}

std::string write_folder(const fs::path& folder, const Record& record, const RecordReport& r, const std::optional<Uncorrected>& before,
                         bool force) {
  check_folder(folder, r, force);
  const bool made = !fs::exists(folder);
  const std::string picture = (folder / "record.svg").string();
  try {
    fs::create_directories(folder);
    write_record_plot(record, r, picture, before ? &*before : nullptr);
    Json json = to_json(r);
    if (before) json["before_correction"] = end_values(before->report);
    write_json((folder / "record.json").string(), json);
  } catch (const std::exception& trouble) {
    std::error_code ignored;
    if (made) fs::remove_all(folder, ignored);
    const auto* mistake = dynamic_cast<const fs::filesystem_error*>(&trouble);
    if (!mistake) throw;
    throw Error(
        fmt::format("output folder \"{}\" cannot be made: {}; choose another with -o DIR", folder.string(), mistake->code().message()));
  }
  return picture;
}

}  // namespace

int verb_record(const RecordCommand& command) {
  if (command.words.empty()) throw Error("record takes a file; write erbs record FILE");
  if (command.words.size() > 1 && !command.output.directory.empty())
    throw Error(fmt::format("-o {} is one folder for {} records; leave it out, and each gets its own", command.output.directory,
                            command.words.size()));
  check_names(command);
  for (const auto& file : command.words) {
    Record wanted = command.record;
    wanted.file = file;
    const Record record = read_record(wanted);
    const RecordReport numbers = report(record);
    std::ostringstream table;
    print(table, numbers);
    const std::optional<Uncorrected> before = uncorrected(wanted);
    if (before)
      table << fmt::format("{:<22} PGA {:.5f} g, PGV {:.4f} m/s, PGD {:.4f} m, end velocity {:.1e} m/s, end displacement {:.1f} mm\n",
                           "before correction", std::abs(before->report.pga.value) / standard_g, std::abs(before->report.pgv.value),
                           std::abs(before->report.pgd.value), before->report.end_velocity, 1e3 * before->report.end_displacement);
    say("{}", table.str());
    const std::string picture = write_folder(folder_of(command, file), record, numbers, before, command.output.force);
    if (!command.output.quiet) say("{:<22} {}\n", "picture", picture);
  }
  return exit_ok;
}

}  // namespace erbs::lua
