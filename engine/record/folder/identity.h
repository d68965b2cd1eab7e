// Which scene a file of a run belongs to: motion.h5 and pictures carry it, so that a file of another run is not taken for one of this.
#pragma once
#include <optional>
#include <string>

#include "engine/record/folder/manifest.h"

namespace erbs {

struct SceneIdentity {
  std::string name;     // of the scene
  std::string hash;     // 16 hex digits: script, files it reads, params and command-line overrides
  std::string program;  // "0.1.0 (1a2b3c4)", which started the run
  std::string text() const { return name + ' ' + hash; }
};

// Paths do not count, so that a folder may be moved.
SceneIdentity identity_of(const Manifest& manifest);
std::optional<SceneIdentity> identity_in(const std::string& dir);  // by DIR/manifest.json; none where that is absent or damaged

// Why what was kept for one identity, such as a picture beside a scene, may not fit another one: "it is of another scene, pier". Both are
// text() of an identity; "" where they are equal, or one is unknown.
std::string difference_of(const std::string& kept, const std::string& now);
bool same_name(const std::string& kept, const std::string& now);  // true where one is unknown

}  // namespace erbs
