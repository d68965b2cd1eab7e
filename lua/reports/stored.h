// Pictures and values that are kept beside a scene, in the folder `expected`: reading, comparing, and renewing them.
//
//   expected/SCENE.json                     values of expect_stored, by key, and the identity of the runs that gave them (stored_for)
//   expected/SCENE_CAMERA_t0.400s.png       pictures of expect_image
//
// A comparison leaves DIR/pictures/CAMERA_t0.400s_{actual,expected,difference}.png and .json in the run folder.
#pragma once
#include <string>
#include <vector>

#include "lua/reports/expectations.h"

namespace erbs::lua {

// The expectations with the values stored beside the scene; NaN for a value that is not stored.
std::vector<Expectation> with_stored_values(std::vector<Expectation> expectations, const std::string& scene);

// Names, in each verdict of a stored value, the file that holds it. A value of another scene than that of `directory` fails, and one of an
// earlier state of the scene is told where it fails.
void name_stored_values(const std::vector<Expectation>& expectations, const std::string& scene, const std::string& directory,
                        std::vector<Verdict>& verdicts);

// Draws each picture that the scene expects, and compares it with the stored one.
std::vector<Verdict> judge_pictures(const Scene& scene, const std::string& path, const std::string& directory);

// Stores what failed: the pictures and values of the run. Returns a line for each file written.
std::vector<std::string> renew(const std::vector<Verdict>& verdicts);

}  // namespace erbs::lua
