#pragma once

#include <string>
#include <vector>

#include "conchoid/io/picture.hpp"
#include "conchoid/io/run_folder.hpp"

namespace conchoid {

/// What a picture of a run shows.
enum class RunView {
  pieces,     ///< the fragments, moved apart; the crack in the body where there is one piece
  crack,      ///< the fine crack surface alone
  intensity,  ///< the fine crack surface, coloured by |K| of the front where it came by
  opening     ///< the crack mesh of the last frame, coloured by how far it is open
};
/// "pieces", "crack", "K", "opening". Throws InputError for another name.
RunView run_view_from_name(const std::string& name);

struct RunPictureSettings {
  RunView view = RunView::pieces;
  double explode = 0.25;  ///< pieces: of the way from the common centre of mass to each one's own
  double exaggerate = 0;  ///< opening: the two faces are moved apart by so many times the opening
};

/// The axis that points up when nobody says so: z, or y where the body is clearly taller in y than in x and z.
Vec3 usual_up(const RunDocument& run);

/// One panel for a run, with its method as title and a caption.
/// @param folder  of the run: its frames are read for the view `opening`
PicturePanel run_panel(const RunData& run, const std::filesystem::path& folder,
                       const RunPictureSettings& settings);

/// One panel per frame, at most `count`, evenly spread over the run and with the last one: the body as a
/// ghost, the crack coloured by |K| (view intensity) or opening (any other; plain once a piece has come off).
std::vector<PicturePanel> frame_panels(const RunData& run, const std::filesystem::path& folder, int count,
                                       const RunPictureSettings& settings);

}  // namespace conchoid
