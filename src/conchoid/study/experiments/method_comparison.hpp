#pragma once

#include <string>
#include <vector>

#include "conchoid/core/vec.hpp"
#include "conchoid/study/experiments/report.hpp"
#include "conchoid/study/experiments/workshop.hpp"

namespace conchoid {

/// A scene of a comparison.
struct ComparedScene {
  std::string title;  ///< "Cube 45"
  std::string text;   ///< of the scene
  /// Noise floor, solved by boundary elements, too: what is changed, text of the scene.
  std::vector<std::pair<std::string, std::string>> changed = {};
  Vec3 up = Vec3::UnitZ();  ///< in pictures
};

/// The closed forms that need no training, each alone and solved every 2nd and 3rd frame.
std::vector<MethodChoice> baselines();

/// The same method with a limit of 2 n + 4 frames, n those of boundary elements on that scene: a run that is lost
/// cannot cost more than that, and ends at the frame limit. Everything below runs methods so.
MethodChoice limited(Workshop& workshop, const std::string& scene_text, MethodChoice method);

/// Boundary elements first, then every method: per scene and method a row with the metrics of
/// conchoid::compare against boundary elements, frames, stop and times; a row per change of the scene that is
/// solved by boundary elements is the noise floor.
ReportTable comparison_table(Workshop& workshop, const std::vector<ComparedScene>& scenes,
                             const std::vector<MethodChoice>& methods);

/// The published Table 3 for such scenes: triangles, seconds, frames.
ReportTable time_table(Workshop& workshop, const std::vector<ComparedScene>& scenes,
                       const std::vector<MethodChoice>& methods);

/// Mean |K| along the front over the frames, one plot per mode, logarithmic.
std::vector<ReportPlot> intensity_plots(Workshop& workshop, const ComparedScene& scene,
                                        const std::vector<MethodChoice>& methods);

/// Distance of the fronts from those of boundary elements over the frames, in r̄, and the crack's area.
std::vector<ReportPlot> front_plots(Workshop& workshop, const ComparedScene& scene,
                                    const std::vector<MethodChoice>& methods);

/// The runs side by side, boundary elements first. @param name  of the file
ReportPicture pieces_picture(Workshop& workshop, const std::string& name, const ComparedScene& scene,
                             const std::vector<MethodChoice>& methods);

/// Frames of one run in progress.
ReportPicture frames_picture(Workshop& workshop, const std::string& name, const ComparedScene& scene,
                             const MethodChoice& method, int frames);

}  // namespace conchoid
