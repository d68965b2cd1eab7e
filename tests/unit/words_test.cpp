// Retired words: names by which nobody from the field would look for a thing. Beside each stands the word in its place.
// Identifiers are read, and in comments those words that can be nothing but a name. Strings are the user's and are not read.
#include <catch2/catch.hpp>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace {

namespace fs = std::filesystem;

// Files by a pattern of their path, and pairs of words: the retired one, the one in its place.
struct Retired {
  std::string files, words;
};

const std::vector<Retired> retired{
    {"(engine|lua|render)/.*", R"(
Sound IntactJoints         SoundBatch IntactPack      SoundLaw IntactConstants  SoundCloser CornerCheck   SoundLanes IntactInput
SoundEnds IntactEnds       sound_batch intact_pack    sound_batches intact_packs sound_lanes intact_forces stays_sound stays_intact
Tier JointStage            JointBatch JointPack       JointLanes ElasticPack    CornerLanes CornerPack    SpotLanes PointPack
SlipLanes SlipPack         CommonLanes MeanSlipPack   BondLanes BondPack        CellLanes CellPack        FaceLanes FacePack
CrackedLanes CrackedPack   PoseLanes PosePack         RowLanes VectorPack       LaneKernels StepKernels   lane_kernels step_kernels
PairLanes PairPack         BlockLanes BlockPosePack   HeldLanes TrialPack       KeptLanes OwnerSchedule   kept_by_b owned_by_b
choose_keepers choose_owners Keeping OwnerBalance     deal_lanes make_owner_schedule Crossing GatherTable first_taken first_gather
go_by_rows use_wrench_rows set_places set_slots       base_u ref_u              base_q ref_q              refresh_all update_all_references
take_stale_poses take_outdated_poses                  turn_minus rotation_change turned_a rotated_a        turned_b rotated_b
let_turn set_rotation_limits turn_limit rotation_limit joint_q joint_gap        look_closer check_points  near_limits may_yield_now
beyond_its_faces out_of_range joint_spent joint_ready_for_contact               none_spent none_ready_for_contact
rub_points friction_at_points Rubbed SlipSums         Stuck StickState          press_deepest assign_to_deepest Met JointMotion
cell_watch tension_loop    cell_corner cell_loop      bed_of compression_face   Picked BlockGather        Pushes ExternalForces
hand_over release_to_contact hand_over_joints release_joints HandOver JointRelease take_handed take_releases take_opened take_released
find_beds find_former_joints soften_beds soften_former_joints part_beds forget_former_joints count_bed bound_former_joint
PairJob PairTask           ClipJob ClipTask           short_keeper cached_axis  stands_apart still_separated keeps_apart surely_separated
Apart PairSeparation       Parting SeparationState    way_soon_ travel_ahead_   list_anew rebuild_lists   full_crowd saturated_contacts
landing_a impact_omega2_a  landing_b impact_omega2_b  rate_a omega2_a           rate_b omega2_b           unless_it_rubs limited_by_slip
counted_a bound_share_a    counted_b bound_share_b    counted_of block_bounds   ask_elsewhere bound_elsewhere goes_in_lanes fits_pack
Knife CutPlan              part_all split_by_nearest_face Borne ReturnResult    borne_dt stable_dt        view_of pair_frame
Debris Contacts            Instant SampleState        dt_goal dt_target         dt_most dt_max            lay_down try_sleep
still_speed sleep_speed    still_pull sleep_acceleration follow_contacts adapt_time_step share_out balance_threads
TrustWatch RunDiagnostics  trust_of diagnostics_of    energy_gate energy_tolerance JointLook JointCondition look_at_joint joint_condition
)"},
    {"engine/(model|laws|joints|contact|solve|analysis)/.*", R"(
sound intact    tier stage         lanes pack_size      keeper owner      keepers owner_computes   hand bucket      deal schedule
turn rotation   turned rotated     turns rotates        th theta          stale outdated           refresh update_reference
crossed gather  crossing gather_table                   spot point        rub friction             rubbing slip_omega2
rubbed by_friction                 hang follow_open_faces                 bear return_map          meet relative_motion
worn damage_changed                conclude finish_step nearness yield_bound                       closely corner_pack
pushes force_loads                 drives prescribed_motions              look update              looked found
follow track    mark add_to_group  eight triangle_pack  job task          crowd contact_count      haste event_rate
landing impact_bound               land add_impact_bound                  spun rotation_travel     separating separating_axis
bulge shape_factor                 halve split_by_diagonal                knife plan               loosen activate_loose_blocks
calm steps_since_limited           stirred last_motion  instant sample_state                       trust diagnostics
gate tolerance  depart apply_overrides                  departures override_arguments              opened released
handed releases Pair ContactPair   View PairFrame       Bed CompressionFace                        Keeper SeparatingFeature
Waiting PairBound                  Looked ThreadPairs   Eight BlockGroup  Fastest MaxSpeed         Push ForceLoad
Drive PrescribedMotion             Rest SleepState      Cold LazyArray    Seat ThreadSlot          Ask RecorderRequest
)"},
    {"engine/(joints|contact|solve)/.*", R"(bed former_joint  given neighbour_force  spent ready_for_contact  bare debonded
watch tension_loop  hold try_stick  borne return_map)"},
};

using Words = std::map<std::string, std::string>;

Words words_of(const std::string& text) {
  Words out;
  std::istringstream in(text);
  for (std::string old, instead; in >> old >> instead;) out[old] = instead;
  return out;
}

// A name that no sentence has: an underscore inside of it, or a capital behind a small letter.
bool is_unmistakable(const std::string& word) {
  static const std::regex name(".*([a-z]_[a-z]|[a-z][A-Z]).*");
  return std::regex_match(word, name);
}

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Calls visit(word, line, whether it stands in a comment) for identifiers and for the words of comments; strings are passed by.
template <class F>
void each_word(const std::string& text, F&& visit) {
  int line = 1;
  bool in_line_comment = false, in_comment = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto starts = [&](const char* what) { return text.compare(i, std::string(what).size(), what) == 0; };
    const char c = text[i];
    if (c == '\n') ++line, in_line_comment = false;
    if (in_comment && starts("*/")) in_comment = false, ++i;
    else if (!in_comment && !in_line_comment && starts("//")) in_line_comment = true;
    else if (!in_comment && !in_line_comment && starts("/*")) in_comment = true, ++i;
    else if (!in_comment && !in_line_comment && starts("R\"")) {
      const std::size_t open = text.find('(', i);
      const std::string end = ")" + text.substr(i + 2, open - i - 2) + "\"";
      const std::size_t last = text.find(end, open) + end.size() - 1;
      for (; i < last; ++i) line += text[i] == '\n';
    } else if (!in_comment && !in_line_comment && (c == '"' || c == '\'')) {
      for (++i; i < text.size() && text[i] != c; ++i) i += text[i] == '\\';
    } else if (is_letter(c)) {
      std::size_t end = i;
      while (end < text.size() && (is_letter(text[end]) || (std::isdigit(static_cast<unsigned char>(c)) != 0 && text[end] == '\''))) ++end;
      visit(text.substr(i, end - i), line, in_comment || in_line_comment);
      i = end - 1;
    }
  }
}

std::vector<std::string> retired_in(const std::string& file, const std::string& text, const Words& words) {
  std::vector<std::string> out;
  each_word(text, [&](const std::string& word, int line, bool in_comment) {
    const auto found = words.find(word);
    if (found == words.end() || (in_comment && !is_unmistakable(word))) return;
    out.push_back(file + ":" + std::to_string(line) + ": " + word + " is retired; say " + found->second);
  });
  return out;
}

}  // namespace

TEST_CASE("no retired word is in use", "[words]") {
  std::vector<std::string> found;
  int files = 0;
  for (const char* top : {"engine", "lua", "render"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(erbs::test::in_source("")) / top)) {
      const std::string kind = entry.path().extension().string();
      if (kind != ".h" && kind != ".cpp" && kind != ".inc") continue;
      ++files;
      const std::string file = fs::relative(entry.path(), erbs::test::in_source("")).generic_string();
      std::ifstream in(entry.path());
      const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
      for (const Retired& list : retired) {
        if (!std::regex_match(file, std::regex(list.files))) continue;
        const std::vector<std::string> here = retired_in(file, text, words_of(list.words));
        found.insert(found.end(), here.begin(), here.end());
      }
    }
  CHECK(files > 300);
  for (const std::string& one : found) FAIL_CHECK(one);
}

TEST_CASE("a word in place of a retired one is not retired itself", "[words]") {
  for (const Retired& list : retired)
    for (const auto& [old, instead] : words_of(list.words)) {
      INFO(old << " -> " << instead);
      CHECK(old != instead);
      for (const Retired& other : retired) CHECK_FALSE(words_of(other.words).contains(instead));
    }
}

TEST_CASE("the words test reads identifiers and names in comments, and passes strings by", "[words]") {
  const Words words = words_of("turn rotation hand_over release_to_contact");
  CHECK(retired_in("a.h", "Mat3 turn;", words).size() == 1);
  CHECK(retired_in("a.h", "\n\nint f(Mat3 turn);", words).front() == "a.h:3: turn is retired; say rotation");
  CHECK(retired_in("a.h", "// blocks turn, and turn back", words).empty());
  CHECK(retired_in("a.h", "// see hand_over()", words).size() == 1);
  CHECK(retired_in("a.h", "/* hand_over */ int turned;", words).size() == 1);
  CHECK(retired_in("a.h", "const char* a = \"turn \\\" turn\"; char b = '\"'; int turn;", words).size() == 1);
  CHECK(retired_in("a.h", "auto a = R\"x(turn \" turn)x\"; int turn;", words).size() == 1);
  CHECK(retired_in("a.h", "int a = 1'000'000, turn = 0;", words).size() == 1);
}
