// A run as one web page: its numbers read back, its texts harmless, nothing loaded from elsewhere.
#include "engine/record/report/report.h"

#include <zlib.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <regex>

#include "engine/record/report/pack.h"
#include "tests/unit/record/two_bricks.h"

using namespace erbs;

namespace {

std::string inflated(const std::string& bytes, std::size_t size) {
  std::string out(size + 1, '\0');
  uLongf length = out.size();
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(out.data()), &length, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()) == Z_OK);
  out.resize(length);
  return out;
}

float float_at(const std::string& bytes, std::size_t at) {
  float value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

// Frames of one resting and two tumbling blocks.
std::vector<MotionFrame> tumbling(int frames) {
  std::vector<MotionFrame> out;
  for (int f = 0; f < frames; ++f) {
    MotionFrame frame{0.01 * f, {}, {std::uint8_t(5 * f)}, {0}};
    for (int b = 0; b < 3; ++b) {
      const auto s = static_cast<float>(b * f);
      const Eigen::Quaternionf q(Eigen::AngleAxisf(0.3F * s, Eigen::Vector3f(1, 2, float(b)).normalized()));
      const float sign = f % 2 ? -1.0F : 1.0F;  // the same rotation
      frame.poses.insert(frame.poses.end(),
                         {0.1F * s, -3.0F + 1e-5F * s, 0.5F - 0.002F * s * s, sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z()});
    }
    out.push_back(frame);
  }
  return out;
}

ReportedRun reported(const std::string& name) {
  ReportedRun run;
  run.run.manifest.title = name;
  run.run.scene.blocks = {
      {name, name, 0, true, Vec3::Zero(), {}}, {"b", "", 0, false, Vec3::Zero(), {}}, {"c", "", 0, false, Vec3::Zero(), {}}};
  run.run.scene.joints.resize(1);
  run.run.frames = tumbling(4);
  run.manifest = {{"scene", {{"name", name}}}};
  run.events = {{0.5, "fall", name, 1, "m"}};
  return run;
}

}  // namespace

TEST_CASE("poses of a page read back within their steps", "[report]") {
  const std::size_t blocks = 3, nframe = 40, count = 7 * blocks * nframe;
  const std::vector<MotionFrame> frames = tumbling(int(nframe));
  const std::string bytes = inflated(deflated(pose_bytes(frames, blocks)), 24 * blocks + 2 * count);
  REQUIRE(bytes.size() == 24 * blocks + 2 * count);
  std::size_t at = 24 * blocks;
  for (std::size_t part = 0; part < 7; ++part)
    for (std::size_t b = 0; b < blocks; ++b) {
      std::uint16_t sum = 0;
      double worst = 0, step = rotation_step;
      for (std::size_t f = 0; f < nframe; ++f, ++at) {
        sum = static_cast<std::uint16_t>(sum + static_cast<unsigned char>(bytes[at]) + 256 * static_cast<unsigned char>(bytes[at + count]));
        const double wanted = frames[f].poses[7 * b + part];
        if (part < 3) {
          step = float_at(bytes, 24 * b + 12 + 4 * part);
          worst = std::max(worst, std::fabs(float_at(bytes, 24 * b + 4 * part) + step * sum - wanted));
        } else {
          worst = std::max(worst, std::fabs(std::fabs(step * static_cast<std::int16_t>(sum)) - std::fabs(wanted)));
        }
      }
      INFO("component " << part << " of block " << b);
      CHECK(worst <= 0.5 * step + 1e-6);  // half a step, and the last digits of a float
      if (part < 3) CHECK(step >= 0.999 * smallest_pose_step);
    }
}

TEST_CASE("damage and columns of a page read back", "[report]") {
  const std::vector<MotionFrame> frames = tumbling(40);
  std::uint8_t sum = 0;
  const std::string damage = damage_bytes(frames, 1);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    sum = static_cast<std::uint8_t>(sum + static_cast<std::uint8_t>(damage[f]));
    CHECK(int(sum) == int(frames[f].damage[0]));
  }
  CsvTable table;
  table.names = {"time_s", "u_m"};
  table.columns = {{0, 1, 2}, {0.5, std::nan(""), -7}};
  const std::string bytes = column_bytes(table);
  std::string last;
  for (std::size_t weight = 0; weight < 4; ++weight) last.push_back(bytes[6 * weight + 5]);
  CHECK(float_at(last, 0) == -7);
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foobar") == "Zm9vYmFy");
}

TEST_CASE("a long curve keeps its peaks", "[report]") {
  CsvTable table;
  table.names = {"time_s", "u_m"};
  table.columns.resize(2);
  table.text.resize(2);
  for (int i = 0; i < 100000; ++i)
    table.columns[0].push_back(1e-3 * i), table.columns[1].push_back(i == 4321 ? 9.0 : i == 77777 ? -8.0 : 0.0);
  const CsvTable thin = thinned(table);
  CHECK(thin.rows() <= most_rows_of_a_curve);
  CHECK(thin.columns[1].size() == thin.rows());
  CHECK(*std::max_element(thin.columns[1].begin(), thin.columns[1].end()) == 9);
  CHECK(*std::min_element(thin.columns[1].begin(), thin.columns[1].end()) == -8);
  CHECK(std::is_sorted(thin.columns[0].begin(), thin.columns[0].end()));
  CHECK(thin.columns[0].back() == table.columns[0].back());
}

TEST_CASE("texts of a run cannot end or change a page", "[report]") {
  const std::string name = "</script><img src=x onerror=alert(1)> \"q\" 'Häuschen' {{script}} <!-- & \xff";
  const ReportPage page{
      "<title>{{title}}</title>{{style}}{{script}}<script id=run>{{run}}</script>{{poses}}{{damage}}{{histories}}{{energy}}", "STYLE",
      "SCRIPT"};
  const std::string html = report_html(reported(name), page, "a <folder>");
  CHECK(html.find("<img") == std::string::npos);
  CHECK(html.find("<!--") == std::string::npos);
  CHECK(html.find("&lt;/script&gt;&lt;img") != std::string::npos);
  CHECK(html.find("H\\u00e4uschen") != std::string::npos);
  CHECK(html.find("Häuschen") != std::string::npos);  // in the title
  std::size_t ends = 0, scripts = 0;
  for (std::size_t at = 0; (at = html.find("</script", at)) != std::string::npos; ++at) ++ends;
  for (std::size_t at = 0; (at = html.find("SCRIPT", at)) != std::string::npos; ++at) ++scripts;
  CHECK(ends == 1);
  CHECK(scripts == 1);
  std::smatch data;
  REQUIRE(std::regex_search(html, data, std::regex("<script id=run>([^<]*)</script>")));
  const Json json = Json::parse(data[1].str());
  CHECK(json["blocks"][0][0].get<std::string>().starts_with("</script><img src=x"));
  CHECK(json["folder"] == "a <folder>");
  CHECK(json["times"].size() == 4);
}
