#include "engine/record/folder/identity.h"

#include <algorithm>
#include <filesystem>

#include "engine/base/hash.h"
#include "engine/base/text.h"

namespace erbs {
namespace {

std::string name_in(const std::string& text) { return text.substr(0, text.rfind(' ')); }

}  // namespace

SceneIdentity identity_of(const Manifest& manifest) {
  std::string text = manifest.scene_hash + '\n';
  std::vector<std::string> inputs;
  for (const auto& [path, hash] : manifest.inputs) inputs.push_back(hash);
  std::sort(inputs.begin(), inputs.end());
  for (const std::string& hash : inputs) text += hash + '\n';
  for (const Param& param : manifest.params) text += fmt::format("{}={}\n", param.name, param.value);
  for (const std::string& argument : manifest.override_arguments) text += argument + '\n';
  return {manifest.scene_name, hash_text(text), fmt::format("{} ({})", manifest.version, manifest.git_hash)};
}

std::optional<SceneIdentity> identity_in(const std::string& dir) {
  if (!std::filesystem::exists(dir + "/manifest.json")) return std::nullopt;
  try {
    return identity_of(read_manifest(dir));
  } catch (const Error&) { return std::nullopt; }  // who needs the manifest reports it
}

std::string difference_of(const std::string& kept, const std::string& now) {
  if (kept.empty() || now.empty() || kept == now) return {};
  if (!same_name(kept, now)) return fmt::format("it is of another scene, {}", shown(name_in(kept), 60));
  return "the script, its files or params have changed since it was stored";
}

bool same_name(const std::string& kept, const std::string& now) { return kept.empty() || now.empty() || name_in(kept) == name_in(now); }

}  // namespace erbs
