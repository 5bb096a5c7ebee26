#include "conchoid/quadrature/triangle_rules.hpp"

#include <array>
#include <cassert>
#include <vector>

namespace conchoid {

namespace {

struct Edge3 {
  double weight, a;  ///< (a, a, 1−2a) and its 3 arrangements
};
struct Inner6 {
  double weight, a, b;  ///< (a, b, 1−a−b) and its 6 arrangements
};

std::vector<RulePoint> expand(double center, std::initializer_list<Edge3> threes,
                              std::initializer_list<Inner6> sixes) {
  std::vector<RulePoint> points;
  if (center > 0) points.push_back({1.0 / 3, 1.0 / 3, 1.0 / 3, center});
  for (const auto& [w, a] : threes) {
    const double c = 1 - 2 * a;
    points.insert(points.end(), {{a, a, c, w}, {a, c, a, w}, {c, a, a, w}});
  }
  for (const auto& [w, a, b] : sixes) {
    const double c = 1 - a - b;
    points.insert(points.end(),
                  {{a, b, c, w}, {b, a, c, w}, {a, c, b, w}, {c, a, b, w}, {b, c, a, w}, {c, b, a, w}});
  }
  return points;
}

struct Tables {
  std::array<std::vector<RulePoint>, 7> points;
  std::array<TriangleRule, 7> rules;
};

Tables make_tables() {
  constexpr std::array<int, 7> degrees = {2, 4, 5, 6, 8, 10, 12};
  Tables t;
  t.points[0] = expand(0, {{0.33333333333333333, 0.16666666666666666667}}, {});
  t.points[1] = expand(
      0, {{0.22338158967801146579, 0.44594849091596488628}, {0.1099517436553218675, 0.091576213509770743471}},
      {});
  t.points[2] = expand(
      0.225,
      {{0.13239415278850618075, 0.47014206410511508974}, {0.12593918054482715255, 0.10128650732345633886}},
      {});
  t.points[3] = expand(
      0,
      {{0.11678627572637936603, 0.24928674517091042129}, {0.050844906370206816921, 0.063089014491502227131}},
      {{0.082851075618373575194, 0.053145049844816947353, 0.31035245103378440542}});
  t.points[4] = expand(0.14431560767778716552,
                       {{0.032458497623198080807, 0.05054722831703097587},
                        {0.1032173705347182494, 0.17056930775176020669},
                        {0.095091634267284624971, 0.45929258829272315474}},
                       {{0.027230314174434994807, 0.26311282963463811715, 0.0083947774099576055032}});
  t.points[5] = expand(
      0.081743329146285981358,
      {{0.013352968813149585362, 0.03205537321694353742}, {0.045957963604744723334, 0.14216110105656426941}},
      {{0.034184648162959418252, 0.029619889488729772423, 0.36914678182781103107},
       {0.025297757707288355275, 0.16370173373718259873, 0.8079306009228790063},
       {0.063904906396424075223, 0.32181299528883535938, 0.1481328857838205447}});
  t.points[6] = expand(0,
                       {{0.0079316425099733266213, 0.024646363436335085122},
                        {0.024266838081452880973, 0.48820375094554111905},
                        {0.049918334928059826742, 0.44011164865859256392},
                        {0.028486052068877584242, 0.10925782765935724328},
                        {0.062541213195902699973, 0.27146250701492600284}},
                       {{0.043227363659414293218, 0.25545422863851981529, 0.11629601967792586201},
                        {0.015083677576512028972, 0.85133779251024126834, 0.021382490256171832194},
                        {0.021783585038607185154, 0.023034156355266322758, 0.29165567973833960214}});
  for (std::size_t i = 0; i < degrees.size(); ++i)
    t.rules[i] = {degrees[i], t.points[i]};
  return t;
}

const Tables& tables() {
  static const Tables t = make_tables();
  return t;
}

}  // namespace

std::span<const TriangleRule> triangle_rules() {
  return tables().rules;
}

const TriangleRule& triangle_rule(int degree) {
  for (const TriangleRule& rule : triangle_rules()) {
    if (rule.degree == degree) return rule;
  }
  assert(false && "no triangle rule of this degree");
  return triangle_rules().back();
}

}  // namespace conchoid
