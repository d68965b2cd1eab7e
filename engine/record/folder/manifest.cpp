#include "engine/record/folder/manifest.h"

#include <cmath>
#include <ctime>

#include "engine/base/hash.h"
#include "engine/base/system/isa.h"
#include "engine/record/folder/build_info.h"
#include "engine/record/results/collapse.h"

namespace erbs {
namespace {

Json json_of(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }

// Every field of a described struct: { name: { "value", "unit" } }.
template <class T>
Json json_of_fields(const T& item) {
  Json json = Json::object();
  for (const auto& field : T::fields()) {
    Json value;
    field.member.visit([&](auto member) {
      if constexpr (std::is_same_v<decltype(member), Vec3 T::*>) value = json_of(item.*member);
      else value = item.*member;
    });
    json[std::string(field.name)] = {{"value", value}, {"unit", std::string(field.unit)}};
  }
  return json;
}

Json json_of_wave(const Wave& wave) {
  return std::visit(
      [](const auto& w) {
        using W = std::decay_t<decltype(w)>;
        Json json = {{"kind", std::string(W::wave_name)}};
        json.update(json_of_fields(w));
        if constexpr (std::is_same_v<W, Record>) json["hash"] = w.hash, json["points"] = w.points, json["title"] = w.title;
        return json;
      },
      wave);
}

Json json_of_rule(const JointRule& rule) {
  Json json = {{"between", {rule.group_a, rule.group_b}}, {"at", rule.place.text()}};
  json.update(json_of_fields(rule));
  json["points"] = {rule.points_long, rule.points_short};
  if (!rule.none)
    json["law"] = std::visit(
        [](const auto& law) {
          Json inner = {{"kind", std::string(std::decay_t<decltype(law)>::law_name)}};
          inner.update(json_of_fields(law));
          if constexpr (requires { law.scatter; })
            if (law.scatter.cv > 0) inner["scatter"] = json_of_fields(law.scatter);
          // What parameters that the script leaves out come to.
          const PointLaw point = law.compile();
          const auto one = [](double value, const char* unit) { return Json{{"value", value}, {"unit", unit}}; };
          inner["in_force"] = {{"kn", one(point.kn, "Pa/m")}, {"ks", one(point.ks, "Pa/m")}, {"mu_residual", one(point.mu_debonded(), "")}};
          return inner;
        },
        rule.law);
  return json;
}

Json json_of_load(const Load& load) {
  static constexpr const char* kinds[] = {"ground_motion", "force", "moment", "tilt", "motion", "turning"};
  Json json = {{"kind", kinds[int(load.kind)]}, {"name", load.name}, {"at", load.place.text()}};
  if (!load.block.empty()) json["block"] = load.block;
  json["direction"] = json_of(load.direction);
  json["wave"] = json_of_wave(load.wave);
  return json;
}

Json json_of_push(const PushSettings& push) {
  Json json = json_of_fields(push);
  json["direction"] = json_of(push.direction);
  json["path"] = push.path;
  json["pattern"] = Json::array();
  for (const PatternForce& one : push.pattern)
    json["pattern"].push_back({{"block", one.block}, {"group", one.group}, {"force_N", json_of(one.force)}});
  json["monitor"] = {{"block", push.monitor.block}};
  if (push.monitor.has_point) json["monitor"]["point_m"] = json_of(push.monitor.point);
  return json;
}

Json json_of_spectrum(const PerformanceDemand& demand) {
  Json json = json_of_fields(demand.spectrum);
  json.update(json_of_fields(demand));
  json["blocks"] = demand.blocks;
  json["table"] = {{"T_s", demand.spectrum.period}, {"Sa_m_s2", demand.spectrum.acceleration}};
  return json;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

double number(const Json& json) { return json.is_number() ? json.get<double>() : std::nan(""); }
Vec3 vec3(const Json& json) { return {number(json.at(0)), number(json.at(1)), number(json.at(2))}; }

Json json_of_manifest(const Manifest& m) {
  Json j = {{"program", "erbs"}, {"version", m.version}, {"git_hash", m.git_hash}, {"compiler", m.compiler},
            {"isa", m.isa},      {"threads", m.threads}, {"started", m.started}};
  j["scene"] = {{"name", m.scene_name}, {"title", m.title},     {"file", m.scene_file},
                {"path", m.scene_path}, {"hash", m.scene_hash}, {"labels", m.labels}};
  j["params"] = Json::array();
  for (const Param& p : m.params)
    j["params"].push_back({{"name", p.name}, {"value", p.value}, {"default", p.fallback}, {"unit", p.unit}, {"text", p.text}});
  j["notes"] = m.notes;
  j["inputs"] = m.inputs;
  j["effects"] = {{"on", m.effects_on}, {"off", m.effects_off}};
  j["arguments"] = m.arguments;
  j["departures"] = m.override_arguments;
  j["dt_s"] = m.dt;
  j["dt_rule"] = m.dt_rule;
  j["dt_critical_s"] = m.dt_critical;
  j["dt_block_bound_s"] = m.dt_block_bound;
  j["duration_s"] = m.duration;
  j["output_dt_s"] = m.output_dt;
  j["frame_dt_s"] = m.frame_dt;
  j["gravity_m_s2"] = json_of(m.gravity);
  j["cameras"] = Json::array();
  for (const Camera& c : m.cameras)
    j["cameras"].push_back(
        {{"name", c.name}, {"eye", json_of(c.eye)}, {"target", json_of(c.target)}, {"up", json_of(c.up)}, {"fov_rad", c.fov}});
  j["materials"] = Json::array();
  for (const Material& a : m.materials) {
    j["materials"].push_back({{"name", a.name},
                              {"color", json_of(a.color)},
                              {"density_kg_m3", a.density},
                              {"kn_Pa_m", a.kn},
                              {"ks_Pa_m", a.ks},
                              {"friction", a.friction},
                              {"restitution", a.restitution}});
    for (const auto& [other, friction] : a.friction_with) j["materials"].back()["friction_with"][other] = friction;
  }
  j["metrics"] = Json::array();
  for (const auto& [name, unit] : m.metric_units) j["metrics"].push_back({{"name", name}, {"unit", unit}});
  j["laws"] = m.laws;
  j["loads"] = m.loads;
  j["settings"] = m.settings;
  return j;
}

Manifest manifest_of_json(const Json& j) {
  Manifest m;
  m.version = j.at("version"), m.git_hash = j.at("git_hash"), m.compiler = j.at("compiler"), m.isa = j.at("isa");
  m.threads = j.at("threads"), m.started = j.at("started");
  const Json& scene = j.at("scene");
  m.scene_name = scene.at("name"), m.title = scene.at("title"), m.scene_file = scene.at("file"), m.scene_hash = scene.at("hash");
  m.scene_path = scene.value("path", "");
  if (scene.contains("labels")) m.labels = scene["labels"].get<std::vector<std::string>>();
  for (const Json& p : j.at("params"))
    m.params.push_back({p.at("name"), number(p.at("value")), number(p.at("default")), p.at("text"), p.at("unit"), {}});
  if (j.contains("notes")) m.notes = j.at("notes").get<std::vector<std::string>>();
  m.inputs = j.at("inputs").get<std::map<std::string, std::string>>();
  m.effects_on = j.at("effects").at("on").get<std::vector<std::string>>();
  m.effects_off = j.at("effects").at("off").get<std::vector<std::string>>();
  if (j.contains("arguments")) m.arguments = j["arguments"].get<std::vector<std::string>>();
  if (j.contains("departures")) m.override_arguments = j["departures"].get<std::vector<std::string>>();
  m.dt = number(j.at("dt_s")), m.dt_rule = j.at("dt_rule");
  m.dt_critical = number(j.at("dt_critical_s")), m.dt_block_bound = number(j.at("dt_block_bound_s"));
  m.duration = number(j.at("duration_s")), m.output_dt = number(j.at("output_dt_s")), m.frame_dt = number(j.at("frame_dt_s"));
  m.gravity = vec3(j.at("gravity_m_s2"));
  for (const Json& c : j.at("cameras"))
    m.cameras.push_back({c.at("name"), vec3(c.at("eye")), vec3(c.at("target")), vec3(c.at("up")), number(c.at("fov_rad")), {}});
  for (const Json& a : j.at("materials"))
    m.materials.push_back({a.at("name"),
                           number(a.at("density_kg_m3")),
                           number(a.at("kn_Pa_m")),
                           number(a.at("ks_Pa_m")),
                           number(a.at("friction")),
                           number(a.at("restitution")),
                           vec3(a.at("color")),
                           {},
                           {}});
  for (const Json& metric : j.at("metrics")) m.metric_units.emplace_back(metric.at("name"), metric.at("unit"));
  m.laws = j.at("laws"), m.loads = j.at("loads"), m.settings = j.at("settings");
  return m;
}

}  // namespace

Manifest manifest_of(const Scene& scene, const std::string& script) {
  Manifest m;
  m.version = build_version;
  m.git_hash = build_git_hash;
  m.compiler = build_compiler;
  m.isa = machine_isa();
  m.started = utc_now();
  m.scene_name = scene.name;
  m.scene_file = scene.file;
  m.scene_hash = hash_text(script);
  m.title = title_of(script);
  m.labels = scene.labels;
  m.params = scene.params;
  m.notes = scene.notes;
  m.inputs = scene.inputs;
  m.duration = scene.analysis.duration;
  m.output_dt = scene.analysis.output_dt;
  m.frame_dt = scene.analysis.frame_dt;
  m.dt_rule = scene.analysis.dt_rule;
  m.gravity = scene.gravity;
  m.cameras = scene.cameras;
  m.materials = scene.materials;
  m.laws = m.loads = Json::array();
  for (const JointRule& rule : scene.joint_rules) m.laws.push_back(json_of_rule(rule));
  for (const Load& load : scene.loads) m.loads.push_back(json_of_load(load));
  m.settings = {{"analysis", json_of_fields(scene.analysis)}, {"damping", json_of_fields(scene.damping)}};
  if (scene.push.quasi_static()) m.settings["push"] = json_of_push(scene.push);
  if (scene.performance.given()) m.settings["spectrum"] = json_of_spectrum(scene.performance);
  return m;
}

void write_manifest(const std::string& dir, const Manifest& manifest) { write_json(dir + "/manifest.json", json_of_manifest(manifest)); }

std::string span_of_event(const Manifest& manifest, double t) { return span_of_event(manifest.output_dt, manifest.frame_dt, t); }

Manifest read_manifest(const std::string& dir) {
  const std::string path = dir + "/manifest.json";
  const Json json = read_json(path);
  try {
    return manifest_of_json(json);
  } catch (const nlohmann::json::exception& mistake) {
    throw Error(fmt::format("not a manifest of this version ({}); run the scene again", mistake.what()), {path, 0});
  }
}

std::string program_version() { return fmt::format("{} ({})", build_version, build_git_hash); }

std::string machine_isa() {
#if defined(__x86_64__)
  const Isa isa = chosen_isa();
  return isa == Isa::avx512 ? "x86-64 avx512f" : isa == Isa::avx2 ? "x86-64 avx2" : "x86-64 sse2";
#elif defined(__aarch64__)
  return "aarch64 neon";
#else
  return "portable";
#endif
}

std::string title_of(const std::string& script) {
  std::size_t at = script.compare(0, 2, "#!") == 0 ? std::min(script.find('\n'), script.size()) : 0;
  at = script.find_first_not_of(" \t\r\n", at);
  if (at == std::string::npos || script.compare(at, 2, "--") != 0) return {};
  at = script.find_first_not_of("-[= \t", at);
  if (at == std::string::npos) return {};
  std::string line = script.substr(at, script.find_first_of("\r\n", at) - at);
  while (!line.empty() && (line.back() == ' ' || line.back() == '-' || line.back() == '=')) line.pop_back();
  return line;
}

}  // namespace erbs
