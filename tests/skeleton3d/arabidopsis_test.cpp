#include "simulated_plants.hpp"
#include "skeleton3d/skeleton3d.hpp"
#include "support/shared_data.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace axil::skeleton3d {
namespace {

/// A silique clicked in two photographs (front = view_000, right = view_090; px): where it leaves the stem, and its tip.
struct Silique {
  glm::dvec2 base[2];
  glm::dvec2 tip[2];
};

/// Clicked in enlarged cuttings of 400 px, shown 1092 px wide, that begin at x = 620 and y = 0, 350 or 680.
glm::dvec2 cut(int y0, double x, double y) { return {620 + x * 400 / 1092, y0 + y * 400 / 1092}; }

/// From the fifth silique (the four below are shoots cut to stumps) to the thirtieth.
std::vector<Silique> siliques() {
  return {
      {{cut(680, 437, 247), cut(680, 757, 441)}, {cut(680, 530, 168), cut(680, 918, 480)}},
      {{cut(680, 437, 188), cut(680, 753, 367)}, {cut(680, 517, 272), cut(680, 633, 437)}},
      {{cut(680, 437, 148), cut(680, 762, 310)}, {cut(680, 313, 105), cut(680, 790, 232)}},
      {{cut(350, 440, 948), cut(680, 767, 217)}, {cut(350, 508, 722), cut(680, 963, 67)}},
      {{cut(350, 440, 883), cut(350, 767, 1040)}, {cut(350, 588, 783), cut(350, 635, 925)}},
      {{cut(350, 439, 851), cut(350, 769, 990)}, {cut(350, 263, 717), cut(350, 740, 783)}},
      {{cut(350, 436, 702), cut(350, 765, 840)}, {cut(350, 547, 503), cut(350, 957, 712)}},
      {{cut(350, 435, 660), cut(350, 758, 780)}, {cut(350, 518, 635), cut(350, 530, 692)}},
      {{cut(350, 432, 537), cut(350, 738, 606)}, {cut(350, 213, 390), cut(350, 690, 402)}},
      {{cut(350, 434, 430), cut(350, 727, 518)}, {cut(350, 607, 225), cut(350, 818, 353)}},
      {{cut(350, 435, 420), cut(350, 723, 497)}, {cut(350, 458, 355), cut(350, 470, 360)}},
      {{cut(350, 447, 286), cut(350, 703, 350)}, {cut(350, 427, 47), cut(350, 902, 132)}},
      {{cut(350, 457, 234), cut(350, 694, 299)}, {cut(350, 672, 100), cut(350, 625, 177)}},
      {{cut(350, 471, 122), cut(350, 663, 168)}, {cut(350, 303, 105), cut(350, 403, 65)}},
      {{cut(0, 497, 985), cut(0, 638, 1027)}, {cut(0, 411, 767), cut(0, 866, 812)}},
      {{cut(0, 513, 927), cut(0, 615, 960)}, {cut(0, 792, 907), cut(0, 512, 960)}},
      {{cut(0, 554, 808), cut(0, 545, 825)}, {cut(0, 393, 798), cut(0, 275, 757)}},
      {{cut(0, 588, 728), cut(0, 507, 758)}, {cut(0, 700, 530), cut(0, 733, 552)}},
      {{cut(0, 605, 685), cut(0, 473, 690)}, {cut(0, 868, 752), cut(0, 252, 762)}},
      {{cut(0, 605, 673), cut(0, 467, 675)}, {cut(0, 317, 566), cut(0, 453, 556)}},
      {{cut(0, 602, 518), cut(0, 446, 518)}, {cut(0, 741, 373), cut(0, 682, 373)}},
      {{cut(0, 600, 480), cut(0, 444, 480)}, {cut(0, 705, 428), cut(0, 180, 417)}},
      {{cut(0, 594, 433), cut(0, 446, 432)}, {cut(0, 394, 473), cut(0, 558, 473)}},
      {{cut(0, 598, 339), cut(0, 453, 338)}, {cut(0, 535, 210), cut(0, 315, 213)}},
      {{cut(0, 599, 333), cut(0, 454, 332)}, {cut(0, 775, 354), cut(0, 575, 352)}},
      {{cut(0, 604, 284), cut(0, 465, 281)}, {cut(0, 503, 240), cut(0, 632, 237)}},
  };
}


double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

TEST(Arabidopsis, TwoPhotographsWithoutCalibrationGiveTheHandsAnglesAndInternodes) {
  AXIL_SKIP_WITHOUT_SHARED("data/plants/real/arabidopsis");
  const auto clicked = siliques();
  std::vector<View> views;
  std::map<std::string, UnknownCameraHints> hints;
  const char* names[] = {"front", "right"};
  for (int v = 0; v < 2; ++v) {
    views.push_back({names[v], {}, {1440, 1080}});
    hints[names[v]].origin_px = PhotoPoint{clicked.front().base[v]};
  }
  hints["front"].scale = KnownLength{{clicked.front().base[0]}, {clicked.back().base[0]}, 0.2};  // any: the hand's scale comes in below
  std::vector<ClickedNode> nodes;
  for (std::size_t i = 0; i < clicked.size(); ++i) {
    const int id = static_cast<int>(2 * i);
    nodes.push_back({NodeId(id), {{"front", {clicked[i].base[0]}}, {"right", {clicked[i].base[1]}}}, std::nullopt});
    nodes.push_back({NodeId(id + 1), {{"front", {clicked[i].tip[0]}}, {"right", {clicked[i].tip[1]}}}, std::nullopt});
  }
  const auto cameras = estimateCameras(views, hints, nodes);
  ASSERT_TRUE(cameras) << cameras.error().message;
  for (const CameraReport& camera : cameras->reports)
    std::printf("%s: focal %.0f +- %.0f px, turned %.1f deg, %.2f px rms\n", camera.view.c_str(), camera.focal_px, camera.focalSigma_px, camera.turned.degrees(), camera.rms_px);
  for (const std::string& note : cameras->notes) std::printf("note: %s\n", note.c_str());
  for (const SuspectClick& s : cameras->suspects) std::printf("suspect: node %d %s %.1f px\n", s.node.value, s.view.c_str(), s.off_px);
  const auto solved = solveNodes(cameras->views, nodes, {.maxReprojection_px = 1000});
  ASSERT_TRUE(solved) << solved.error().message;

  const auto base = [&](std::size_t i) { return (*solved)[2 * i].position.at; };
  const auto stemAt = [&](std::size_t i) { return PlantDirection::along(base(std::min(i + 2, clicked.size() - 1)) - base(i < 2 ? 0 : i - 2)); };
  const auto outward = [&](std::size_t i) { return PlantDirection::along((*solved)[2 * i + 1].position.at - base(i)); };
  std::ifstream file(test::sharedPath("data/plants/real/arabidopsis/measures.json"));
  const auto hand = nlohmann::json::parse(file);
  constexpr std::size_t kFirst = 4;  // of the hand's list
  std::vector<double> turns, ours, theirs;
  for (std::size_t i = 1; i < clicked.size(); ++i) {
    turns.push_back(signedAngleAbout(stemAt(i), outward(i - 1), outward(i)).degrees());
    ours.push_back(glm::length(base(i) - base(i - 1)));
    theirs.push_back(hand["internodes"][kFirst + i - 1].get<double>());
  }
  // Which way round the spiral goes is the plant's; the hand counts along it.
  const auto differencesAs = [&](double sense) {
    std::vector<double> differences;
    for (std::size_t i = 0; i < turns.size(); ++i)
      differences.push_back(std::abs(std::remainder(sense * turns[i] - hand["angles"][kFirst + i].get<double>() * 180 / std::numbers::pi, 360.0)));
    return differences;
  };
  const double sense = median(differencesAs(1)) < median(differencesAs(-1)) ? 1 : -1;
  const auto differences = differencesAs(sense);
  double both = 0, own = 0, sumOurs = 0, sumTheirs = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    both += ours[i] * theirs[i];
    own += ours[i] * ours[i];
    sumOurs += ours[i];
    sumTheirs += theirs[i];
  }
  const double scale = both / own, n = static_cast<double>(ours.size());
  double sxy = 0, sxx = 0, syy = 0, off = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    sxy += (ours[i] - sumOurs / n) * (theirs[i] - sumTheirs / n);
    sxx += std::pow(ours[i] - sumOurs / n, 2);
    syy += std::pow(theirs[i] - sumTheirs / n, 2);
    off += std::abs(scale * ours[i] - theirs[i]) / n;
  }
  for (std::size_t i = 0; i < ours.size(); ++i)
    std::printf("silique %2zu: internode %5.1f mm, hand %4.0f; divergence %6.1f, hand %5.0f, differ by %5.1f deg\n", i + 6, scale * ours[i], theirs[i],
                std::fmod(sense * turns[i] + 360, 360), hand["angles"][kFirst + i].get<double>() * 180 / std::numbers::pi, differences[i]);
  std::printf("%zu siliques: divergence median difference %.1f deg; internodes correlation %.3f, mean difference %.2f mm\n", clicked.size(), median(differences), sxy / std::sqrt(sxx * syy), off);
  EXPECT_LE(median(differences), 10);
  EXPECT_GE(sxy / std::sqrt(sxx * syy), 0.95);
  EXPECT_LE(off, 2.0);
}

}  // namespace
}  // namespace axil::skeleton3d
