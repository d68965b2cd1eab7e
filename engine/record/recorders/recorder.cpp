#include "engine/record/recorders/recorder.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "engine/base/spelling.h"
#include "engine/base/text.h"
#include "engine/record/recorders/recorders.h"

namespace erbs {
namespace {

// Calls f once for each type of THE LIST, with a null pointer of that type.
template <class... Kinds, class F>
void each_kind(const std::variant<Kinds...>*, F&& f) {
  (f(static_cast<const Kinds*>(nullptr)), ...);
}
constexpr const AnyRecorder* the_list = nullptr;

std::vector<std::string> quantity_names() {
  std::vector<std::string> names;
  for (const Quantity& quantity : recorder_quantities()) names.push_back(quantity.name);
  return names;
}

template <class K>
bool is(const std::string& quantity) {
  return quantity_index(K::quantities(), quantity) >= 0;
}

// A key that its quantity cannot use would be ignored in silence, and the column taken for another one.
void check_unused(const Recorder& r, const std::function<void(const std::string&)>& say) {
  const std::string& q = r.quantity;
  const bool ground = is<GroundMotion>(q), count = is<Count>(q), joint = is<JointQuantity>(q);
  if (!r.blocks.empty() && (ground || count))
    say(fmt::format("{} is of the {}, not of blocks; leave out block, blocks and group", q, ground ? "ground" : "whole model"));
  if (!r.others.empty() && !joint)
    say(fmt::format("{} is no quantity of joints, which have another side; leave out others and other_group", q));
  if (r.has_point && (ground || count || joint)) say(fmt::format("point goes with quantities of blocks, not with {}; leave it out", q));
  if (r.frame == "abs" && !is<BlockMotion>(q)) say(fmt::format("frame goes with the motion of blocks, not with {}; leave it out", q));
}

void check_one(const Recorder& r, const std::set<std::string>& blocks, std::vector<std::string>& mistakes) {
  const auto say = [&](const std::string& what) {
    mistakes.push_back(Error(fmt::format("recorder \"{}\": {}", r.name, what), r.place).what());
  };
  const std::vector<std::string> known = quantity_names();
  if (std::find(known.begin(), known.end(), r.quantity) == known.end())
    say(fmt::format("there is no quantity \"{}\"{}; allowed: {}", r.quantity,
                    nearest(r.quantity, known).empty() ? "" : did_you_mean(r.quantity, known), fmt::join(known, ", ")));
  else if (is<BlockMotion>(r.quantity) && r.blocks.empty()) say(fmt::format("{} of which block? Give block, blocks or group", r.quantity));
  else check_unused(r, say);
  std::set<std::string> listed;
  for (const auto* list : {&r.blocks, &r.others})
    for (const std::string& block : *list)
      if (!listed.insert(block).second) say(fmt::format("block \"{}\" is listed twice, and would count twice; leave one out", block));
      else if (!blocks.contains(block))
        say(fmt::format("there is no block \"{}\"{}", block, did_you_mean(block, std::vector<std::string>(blocks.begin(), blocks.end()))));
  if (r.axis.empty() || r.axis.find_first_not_of("xyz") != std::string::npos)
    say(fmt::format("axis = \"{}\"; it takes letters of \"xyz\"", r.axis));
  if (r.frame != "rel" && r.frame != "abs") say(fmt::format("frame = \"{}\"; it is \"rel\" (to the ground) or \"abs\"", r.frame));
  std::string word = r.name;  // points may separate its parts: "a.v01"
  std::replace(word.begin(), word.end(), '.', '_');
  if (!is_name(word)) say("its name becomes that of a column: letters, digits, _, +, - and . only");
}

std::vector<int> numbers_of(const std::vector<std::string>& names, const std::map<std::string, int>& number) {
  std::vector<int> blocks;
  for (const std::string& name : names) blocks.push_back(number.at(name));
  return blocks;
}

}  // namespace

int quantity_index(const std::vector<Quantity>& quantities, const std::string& name) {
  for (std::size_t i = 0; i < quantities.size(); ++i)
    if (quantities[i].name == name) return int(i);
  return -1;
}

std::vector<std::string> axis_columns(const std::string& name, const std::string& axis, const std::string& symbol,
                                      const std::string& unit) {
  std::vector<std::string> columns;
  for (const char letter : axis) columns.push_back(name + "_" + symbol + letter + "_" + unit);
  return columns;
}

void put_axes(const Vec3& value, const std::string& axis, double* out) {
  for (const char letter : axis) *out++ = value[letter - 'x'];
}

std::vector<Quantity> recorder_quantities() {
  std::vector<Quantity> all;
  each_kind(the_list, [&](auto* kind) {
    for (auto& quantity : std::decay_t<decltype(*kind)>::quantities()) all.push_back(quantity);
  });
  return all;
}

std::vector<std::string> check_recorders(const Scene& scene) {
  std::set<std::string> blocks;
  for (const Block& block : scene.blocks) blocks.insert(block.name);
  std::vector<std::string> mistakes;
  for (const Recorder& recorder : scene.recorders) check_one(recorder, blocks, mistakes);
  return mistakes;
}

struct Recorders::Kinds {
  std::vector<AnyRecorder> list;
  std::vector<std::size_t> width;  // columns of each recorder
};

Recorders::Recorders(const Scene& scene, const Model& model) : kinds_(std::make_unique<Kinds>()), columns_{"time_s"} {
  std::vector<std::string> mistakes = check_recorders(scene);
  if (!mistakes.empty()) throw Errors(std::move(mistakes));
  std::map<std::string, int> number;
  for (int b = 0; b < model.nblock; ++b) number[model.block_name[std::size_t(b)]] = b;

  std::vector<Recorder> wanted;
  const auto always = [&](const char* name, const char* quantity) {
    wanted.emplace_back();
    wanted.back().name = name;
    wanted.back().quantity = quantity;
  };
  if (!model.grounds.empty()) always("ground", "ground_acceleration");
  if (!model.tilts.empty() || scene.push.tilts()) always("gravity", "gravity");
  wanted.insert(wanted.end(), scene.recorders.begin(), scene.recorders.end());
  std::set<std::string> taken{"time_s"};
  for (const Recorder& recorder : wanted) {
    const RecorderRequest request{recorder, model, numbers_of(recorder.blocks, number), numbers_of(recorder.others, number)};
    each_kind(the_list, [&](auto* kind) {
      using K = std::decay_t<decltype(*kind)>;
      if (quantity_index(K::quantities(), recorder.quantity) < 0) return;
      try {
        kinds_->list.emplace_back(K(request));
      } catch (const Error& mistake) {
        mistakes.push_back(mistake.what());
        return;
      }
      std::vector<std::string> columns = std::get<K>(kinds_->list.back()).columns();
      kinds_->width.push_back(columns.size());
      for (std::string& column : columns) {
        if (!taken.insert(column).second)
          mistakes.push_back(
              Error(fmt::format("recorder \"{}\": column \"{}\" is written already; give it another name", recorder.name, column),
                    recorder.place)
                  .what());
        columns_.push_back(std::move(column));
      }
    });
  }
  if (!mistakes.empty()) throw Errors(std::move(mistakes));
  row_.resize(columns_.size());
}

Recorders::~Recorders() = default;
Recorders::Recorders(Recorders&&) noexcept = default;
Recorders& Recorders::operator=(Recorders&&) noexcept = default;

Needs Recorders::needs() const {
  Needs needs;
  for (const AnyRecorder& any : kinds_->list) std::visit([&](const auto& kind) { kind.needs(needs); }, any);
  return needs;
}

const std::vector<double>& Recorders::sample(const Snapshot& snapshot) {
  row_[0] = snapshot.t;
  double* out = row_.data() + 1;
  for (std::size_t i = 0; i < kinds_->list.size(); ++i) {
    std::visit([&](const auto& kind) { kind.sample(snapshot, out); }, kinds_->list[i]);
    out += kinds_->width[i];
  }
  return row_;
}

}  // namespace erbs
