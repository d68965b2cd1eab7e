#include "lua/reports/stored.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "engine/base/text.h"
#include "engine/record/folder/identity.h"
#include "engine/record/folder/run_folder.h"
#include "lua/program/child.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& scene) { return fs::path(scene).parent_path() / "expected"; }
std::string values_of(const std::string& scene) { return (folder_of(scene) / (fs::path(scene).stem().string() + ".json")).string(); }

std::string stem_of(const PictureExpectation& picture) { return fmt::format("{}_t{:.3f}s", file_stem(picture.camera), picture.t); }

// Draws one picture and compares it with the stored one; returns why that failed, or "".
std::string draw(const PictureExpectation& picture, const std::string& stored, const std::string& directory) {
  const std::string log = run_file(directory, "pictures/" + stem_of(picture) + ".log");
  fs::create_directories(fs::path(log).parent_path());
  const int code = wait_for(start({renderer_path(), directory, "--stills", fmt::format("{}", picture.t), "--camera", picture.camera,
                                   "--size", fmt::format("{}x{}", picture.width, picture.height), "--color", picture.color, "--no-figures",
                                   "--force", "--quiet", "--expect", stored},
                                  log));
  return code == 0 ? "" : last_words(log, code, directory);
}

// Of the run that gave the value of this key; "" in files of earlier versions.
std::string stored_for(const Json& values, const std::string& key) {
  const auto known = values.find("stored_for");
  return known != values.end() && known->is_object() ? known->value(key, "") : "";
}

// Fails what was stored for another scene, and adds to `words` why what was stored may not fit.
void judge_identity(const std::string& kept, Verdict& verdict, std::string& words) {
  if (!same_name(kept, verdict.scene)) verdict.passed = false, verdict.used = std::numeric_limits<double>::infinity();
  if (!verdict.passed)
    if (const std::string why = difference_of(kept, verdict.scene); !why.empty()) words += "; " + why;
}

void judge_difference(const PictureExpectation& picture, const Json& difference, Verdict& verdict) {
  if (!difference.value("stored", false)) {
    verdict.got = "no picture is stored yet; erbs test --bless stores this one";
    return;
  }
  if (!difference.value("same_size", false)) {
    verdict.got = "the stored picture has another size";
    return;
  }
  verdict.scene = difference.value("scene", "");
  const double pixels = difference.value("failed_fraction", 1.0), ssim = difference.value("ssim", 0.0);
  verdict.got = fmt::format("{:.2g} % of the pixels differ, SSIM {:.4f}", 100 * pixels, ssim);
  verdict.passed = pixels <= picture.pixels && ssim >= picture.ssim;
  const auto share = [](double value, double limit) { return value <= 0 ? 0 : limit > 0 ? value / limit : HUGE_VAL; };
  verdict.used = std::max(share(pixels, picture.pixels), share(1 - ssim, 1 - picture.ssim));
  judge_identity(difference.value("stored_scene", ""), verdict, verdict.got);
}

Verdict judge_picture(const PictureExpectation& picture, const std::string& scene, const std::string& directory) {
  Verdict verdict;
  const std::string stem = stem_of(picture);
  verdict.key = fmt::format("picture {} at {:g} s", picture.camera, picture.t);
  verdict.stored = (folder_of(scene) / (fs::path(scene).stem().string() + "_" + stem + ".png")).string();
  verdict.actual = run_file(directory, "pictures/" + stem + "_actual.png");
  verdict.expected = "as " + verdict.stored;
  verdict.tolerance = fmt::format("{:g} %, SSIM {:g}", 100 * picture.pixels, picture.ssim);
  verdict.source = picture.source;
  verdict.place = picture.place.text();
  verdict.used = std::numeric_limits<double>::infinity();
  const std::string trouble =
      can_start(renderer_path()) ? draw(picture, verdict.stored, directory) : "erbs-render is not there; build or install both programs";
  if (trouble.empty()) judge_difference(picture, read_json(run_file(directory, "pictures/" + stem + ".json")), verdict);
  else verdict.got = trouble, verdict.stored.clear();  // nothing to renew it with
  if (!verdict.passed && trouble.empty() && fs::exists(run_file(directory, "pictures/" + stem + "_difference.png")))
    verdict.got += "; see " + run_file(directory, "pictures/" + stem + "_difference.png");
  return verdict;
}

}  // namespace

std::vector<Expectation> with_stored_values(std::vector<Expectation> expectations, const std::string& scene) {
  const bool any = std::any_of(expectations.begin(), expectations.end(), [](const Expectation& item) { return item.stored; });
  if (!any) return expectations;
  const std::string file = values_of(scene);
  const Json values = fs::exists(file) ? read_json(file) : Json::object();
  for (Expectation& item : expectations) {
    if (!item.stored) continue;
    const bool known = values.contains(item.key) && values[item.key].is_number();
    item.value = known ? values[item.key].get<double>() : std::numeric_limits<double>::quiet_NaN();
  }
  return expectations;
}

void name_stored_values(const std::vector<Expectation>& expectations, const std::string& scene, const std::string& directory,
                        std::vector<Verdict>& verdicts) {
  const std::string file = values_of(scene);
  const Json values = fs::exists(file) ? read_json(file) : Json::object();
  const std::optional<SceneIdentity> identity = identity_in(directory);
  for (std::size_t i = 0; i < expectations.size() && i < verdicts.size(); ++i) {
    if (!expectations[i].stored) continue;
    Verdict& verdict = verdicts[i];
    verdict.stored = file;
    verdict.scene = identity ? identity->text() : "";
    if (std::isnan(expectations[i].value)) verdict.expected = "none stored yet; erbs test --bless stores it";
    else judge_identity(stored_for(values, verdict.key), verdict, verdict.expected);
  }
}

std::vector<Verdict> judge_pictures(const Scene& scene, const std::string& path, const std::string& directory) {
  std::vector<Verdict> verdicts;
  for (const PictureExpectation& picture : scene.pictures) verdicts.push_back(judge_picture(picture, path, directory));
  return verdicts;
}

std::vector<std::string> renew(const std::vector<Verdict>& verdicts) {
  std::vector<std::string> lines;
  std::map<std::string, Json> values;
  for (const Verdict& verdict : verdicts) {
    if (verdict.passed || verdict.stored.empty() || verdict.actual.empty()) continue;
    fs::create_directories(fs::path(verdict.stored).parent_path());
    if (verdict.stored.ends_with(".json")) {
      if (!values.contains(verdict.stored))
        values[verdict.stored] = fs::exists(verdict.stored) ? read_json(verdict.stored) : Json::object();
      values[verdict.stored][verdict.key] = Json::parse(verdict.actual);
      if (!verdict.scene.empty()) values[verdict.stored]["stored_for"][verdict.key] = verdict.scene;
      lines.push_back(fmt::format("stored {} = {} in {} (before: {})", verdict.key, verdict.got, verdict.stored, verdict.expected));
    } else {
      fs::copy_file(verdict.actual, verdict.stored, fs::copy_options::overwrite_existing);
      lines.push_back(fmt::format("stored {} ({})", verdict.stored, verdict.got));
    }
  }
  for (const auto& [file, json] : values) write_json(file, json);
  return lines;
}

}  // namespace erbs::lua
