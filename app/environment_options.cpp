#include "app/environment_options.hpp"

#include "base/files.hpp"
#include "base/text.hpp"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace axil::app {

namespace {

/// The numbers of "1,2.5,-3", or nothing unless there are `count`.
std::optional<std::vector<double>> numbersIn(std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const auto number = parseNumber(text.substr(at, comma - at));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    at = comma + 1;
  }
  return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

struct VectorOption {
  const char* name;
  std::optional<glm::dvec3> simeco::Environment::*vector;
  const char* help;
};
constexpr VectorOption kVectors[] = {
    {"--light", &simeco::Environment::light, "Where the light comes from; acts on organs with LightTropism or LightResponse"},
    {"--gravity", &simeco::Environment::gravity, "Where down is; acts on organs with GravityTropism, and on what withers"},
    {"--wind", &simeco::Environment::wind, "Where the wind blows to; its length is how far a stem across it turns, in radians"}};

struct NumberOption {
  const char* name;
  std::optional<double> simeco::Environment::*number;
  const char* help;
};
constexpr NumberOption kNumbers[] = {{"--soil-ph", &simeco::Environment::soilPH, "pH of the soil; plants grow best at 7 unless the grammar says otherwise"},
                                     {"--rain", &simeco::Environment::rainRate, "Rain; best at 0.9"},
                                     {"--day-light", &simeco::Environment::dayLight, "Hours of light a day; best at 12"},
                                     {"--temperature", &simeco::Environment::temperature, "Degrees Celsius; best at 22"}};

constexpr std::string_view kSphere = "sphere:", kBox = "box:", kMesh = "mesh:";

simeco::Obstacle meshIn(const std::string& path) {
  constexpr std::uintmax_t mostBytes = 100'000'000;
  const auto text = readFile(path, mostBytes);
  if (!text) throw CLI::ValidationError("--obstacle", text.error().message);
  auto mesh = simeco::obstacleFromObj(*text);
  if (!mesh) throw CLI::ValidationError("--obstacle", "'" + path + "': " + mesh.error().message);
  return *std::move(mesh);
}

std::optional<simeco::Obstacle> obstacleIn(const std::string& text) {
  if (text.starts_with(kSphere)) {
    const auto n = numbersIn(std::string_view(text).substr(kSphere.size()), 4);
    if (n) return simeco::SphereObstacle{{{(*n)[0], (*n)[1], (*n)[2]}}, (*n)[3]};
  }
  if (text.starts_with(kBox)) {
    const auto n = numbersIn(std::string_view(text).substr(kBox.size()), 6);
    if (n) return simeco::BoxObstacle{{{(*n)[0], (*n)[1], (*n)[2]}}, {{(*n)[3], (*n)[4], (*n)[5]}}};
  }
  if (text.starts_with(kMesh)) return meshIn(text.substr(kMesh.size()));
  return std::nullopt;
}

}  // namespace

void addEnvironment(CLI::App& sub, simeco::Environment& environment) {
  constexpr const char* kGroup = "Environment (counts over what the grammar says)";
  for (const VectorOption& row : kVectors)
    sub.add_option_function<std::string>(row.name, [&environment, &row](const std::string& text) {
          const auto n = numbersIn(text, 3);
          if (!n) throw CLI::ValidationError(row.name, "takes three numbers x,y,z, not '" + text + "'");
          environment.*row.vector = glm::dvec3{(*n)[0], (*n)[1], (*n)[2]};
        }, row.help)->option_text("X,Y,Z")->group(kGroup);
  for (const NumberOption& row : kNumbers)
    sub.add_option_function<double>(row.name, [&environment, &row](const double& number) { environment.*row.number = number; }, row.help)->group(kGroup);
  sub.add_option_function<std::vector<std::string>>("--obstacle", [&environment](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
          const auto obstacle = obstacleIn(text);
          if (!obstacle) throw CLI::ValidationError("--obstacle", "takes sphere:x,y,z,radius, box:x,y,z,x,y,z or mesh:file.obj, not '" + text + "'");
          environment.obstacles.push_back(*obstacle);
        }
      }, "Something solid that nothing grows through; may be given again")->option_text("sphere:X,Y,Z,R | box:X,Y,Z,X,Y,Z | mesh:FILE.obj")->allow_extra_args(false)->group(kGroup);
}

}  // namespace axil::app
