#include "lua/program/run_again.h"

#include <algorithm>
#include <filesystem>

#include "engine/record/folder/manifest.h"
#include "engine/record/folder/run_folder.h"
#include "lua/program/child.h"
#include "lua/program/command_line.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

std::string absolute(const std::string& path) { return fs::absolute(path).lexically_normal().string(); }

// What belongs to the run, and so comes from its manifest alone.
void refuse_beside(const RunCommand& wish) {
  std::vector<std::string> words = scene_arguments(wish.scene);
  for (const auto& word : override_arguments(wish)) words.push_back(word);
  if (!wish.output.directory.empty()) words.insert(words.begin(), {"-o", wish.output.directory});
  if (words.empty()) return;
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + shell_word(word);
  throw Error(
      fmt::format("{}: a run that is resumed by its folder keeps its scene, options and folder; leave this out, or run the scene "
                  "anew into another folder",
                  text));
}

// The manifest, which says where the scene is and with which options it runs. `line` resumes the run without it.
Manifest kept_manifest(const std::string& folder, const std::string& line) {
  std::string why = "does not say where the scene is";
  try {
    Manifest manifest = read_manifest(folder);
    if (!manifest.scene_path.empty()) return manifest;
  } catch (const Error&) { why = "is missing or damaged"; }
  throw Error(fmt::format("the manifest.json in {} {}; name the scene, with the options of the run: {}", shown(folder), why, line));
}

}  // namespace

std::vector<std::string> kept_arguments(const RunCommand& command) {
  SceneOptions scene = command.scene;
  for (std::string& allowed : scene.allow) allowed = absolute(allowed);
  std::vector<std::string> words = scene_arguments(scene);
  if (command.threads > 0) words.insert(words.end(), {"--threads", std::to_string(command.threads)});
  if (!command.study.empty()) words.insert(words.end(), {"--study", command.study});
  if (!command.studies) words.emplace_back("--no-studies");
  if (command.twin) words.emplace_back("--twin");
  return words;
}

RunCommand with_kept_arguments(const RunCommand& wish) {
  const std::string& folder = wish.words.front();
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored) || !is_run_folder(folder)) return wish;
  if (!wish.resume)
    throw Error(fmt::format("{} is the folder of a run, not a scene; to go on with that run: {}", shown(folder), resume_line(folder)));
  refuse_beside(wish);
  const std::string line = fmt::format("erbs run SCENE.lua -o {} --resume", shell_word(folder));
  const Manifest manifest = kept_manifest(folder, line);
  std::vector<std::string> words{"run", manifest.scene_path, "-o", folder};
  for (const auto& kept : {manifest.arguments, manifest.override_arguments}) words.insert(words.end(), kept.begin(), kept.end());
  if (!fs::exists(manifest.scene_path, ignored)) {
    std::string options;
    for (std::size_t i = 4; i < words.size(); ++i) options += " " + shell_word(words[i]);
    throw Error(fmt::format("the scene {} of the run in {} is gone; put it back, or name its new place: {}{}", shown(manifest.scene_path),
                            shown(folder), line, options));
  }
  const RunCommand kept = read_run(words);
  RunCommand command = wish;
  command.words = kept.words, command.output.directory = folder;
  command.scene = kept.scene, command.changes = kept.changes, command.twin_noise = kept.twin_noise;
  command.study = kept.study, command.studies = kept.studies && wish.studies, command.twin = kept.twin || wish.twin;
  if (command.threads <= 0) command.threads = kept.threads;
  return command;
}

std::string resume_line(const std::string& directory) { return fmt::format("erbs run {} --resume", shell_word(directory)); }

}  // namespace erbs::lua
