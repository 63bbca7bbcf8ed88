#include "stability/matrix.h"

namespace tenku::stability {

const std::vector<Heading>& methods() {
  static const std::vector<Heading> kMethods{
      {"rays", "rays"},
      {"shadow_maps", "shadow maps"},
      {"sky_elements", "sky elements"},
      {"sun_disc", "sun disc"},
      {"paths", "path tracing"},
      {"radiosity", "radiosity"},
      {"form_factors", "form factors (five methods)"},
      {"meshes", "meshes (uniform, refine, bubble)"},
      {"mirrors", "mirrors, beams"},
      {"flythrough", "fly-through"},
      {"readers", "readers"},
      {"sun_position", "position of the sun"},
  };
  return kMethods;
}

const std::vector<Heading>& hazards() {
  static const std::vector<Heading> kHazards{
      {"sun_low", "sun at 0 and 0.1 degrees, half set"},
      {"sun_high", "sun at 89.9 degrees"},
      {"sky_extremes", "skies at the ends of their range"},
      {"on_edges", "sensors on edges, vertices, in corners"},
      {"off_wall", "sensors 1e-6 m off a wall"},
      {"inside_solid", "sensors or eyes inside a solid"},
      {"ray_edges", "rays along edges and through vertices"},
      {"coplanar", "coplanar and coincident faces"},
      {"intersecting", "solids that intersect"},
      {"slivers", "slivers"},
      {"open_solid", "open solids"},
      {"inverted", "inverted solids"},
      {"duplicated", "everything twice"},
      {"scale", "scale 1e-3 to 1e5"},
      {"offset", "1e7 m from the file's origin"},
      {"units", "millimetres taken for metres"},
      {"zero_window", "windows and faces without area"},
      {"bright", "reflectance 0.99"},
      {"mirrors_facing", "mirrors that face each other"},
      {"one_triangle", "one triangle"},
      {"ten_million", "ten million triangles"},
      {"threads", "1 to 8 threads"},
      {"memory", "half of the memory"},
      {"poles", "poles"},
      {"date_line", "date line"},
      {"leap_second", "leap second"},
      {"daylight_saving", "change of daylight saving"},
  };
  return kHazards;
}

namespace {

using Names = std::vector<std::string>;

struct Reason {
  Names methods, hazards;
  std::string why;
};

const std::vector<Reason>& reasons() {
  static const Names kTimes{"poles", "date_line", "leap_second", "daylight_saving"};
  static const Names kGeometry{"on_edges", "off_wall",     "inside_solid", "ray_edges",
                               "coplanar", "intersecting", "slivers",      "open_solid",
                               "inverted", "duplicated",   "scale",        "offset",
                               "units",    "zero_window",  "one_triangle", "ten_million"};
  static const Names kDirect{"rays", "shadow_maps", "sky_elements", "sun_disc"};
  static const Names kSensorPlaces{"on_edges", "off_wall", "inside_solid"};
  static const std::vector<Reason> kReasons{
      {{"sun_position"}, kGeometry, "knows no geometry"},
      {{"sun_position"},
       {"bright", "mirrors_facing", "memory", "threads", "sky_extremes"},
       "a formula of place and time"},
      {{"rays", "shadow_maps", "sky_elements", "sun_disc", "paths", "radiosity", "form_factors",
        "meshes", "mirrors", "flythrough", "readers"},
       kTimes,
       "takes the direction of the sun, not a time"},
      {{"rays", "sky_elements"}, {"sun_high"}, "the sun is a disc of its own: that column"},
      {{"sky_elements"}, {"sun_low"}, "the sun is a disc of its own: that column"},
      {{"rays", "shadow_maps", "sun_disc", "paths", "radiosity", "meshes", "mirrors", "flythrough"},
       {"sky_extremes"},
       "takes luminances as the sky gives them"},
      {{"rays", "shadow_maps", "sky_elements", "sun_disc", "paths", "radiosity", "form_factors",
        "meshes", "mirrors", "flythrough"},
       {"units"},
       "light does not depend on the scale; the reader tells"},
      {kDirect, {"bright", "mirrors_facing"}, "direct light reflects nothing"},
      {{"rays", "shadow_maps", "sky_elements", "sun_disc", "paths", "form_factors", "meshes",
        "mirrors", "readers"},
       {"memory"},
       "has no setting of memory"},
      {{"paths", "radiosity", "meshes", "flythrough"},
       {"sun_low", "sun_high"},
       "sunlight is that of the sun disc"},
      {{"radiosity", "meshes", "form_factors"}, {"mirrors_facing"}, "diffuse surfaces only"},
      {{"form_factors"}, {"sun_low", "sun_high", "sky_extremes", "bright"}, "geometry only"},
      {{"form_factors", "mirrors"}, kSensorPlaces, "has areas, no sensors"},
      {{"form_factors"}, {"open_solid"}, "what leaves is the rest of its row"},
      {{"mirrors"}, {"open_solid"}, "asks for faces, not for solids"},
      {{"flythrough"},
       {"ray_edges", "offset", "one_triangle"},
       "its points are sensors of rays: that column"},
      {{"flythrough"}, {"bright", "mirrors_facing"}, "its light is that of paths: that column"},
      {{"paths", "form_factors", "mirrors", "flythrough"},
       {"ten_million"},
       "not run at this size: the tree is that of rays"},
      {{"readers"}, {"ten_million", "scale", "threads"}, "read by the cells of rays"},
      {{"readers"},
       {"sun_low", "sun_high", "sky_extremes", "mirrors_facing", "ray_edges"},
       "reads geometry only"},
      {{"readers"}, kSensorPlaces, "reads no sensors"},
      {{"readers"}, {"intersecting"}, "not looked for: no method errs there"},
  };
  return kReasons;
}

struct Elsewhere {
  std::string method, hazard, test;
};

const std::vector<Elsewhere>& tested_elsewhere() {
  static const std::vector<Elsewhere> kTests{
      {"rays", "sun_low", "BothEngines.ASunOnTheHorizonLightsAWidePlain"},
      {"shadow_maps", "sun_low", "BothEngines.ASunOnTheHorizonLightsAWidePlain"},
      {"sky_elements", "sky_extremes", "MakeSky.PerezClampsAreFindings"},
      {"paths", "open_solid", "ReflectedLight.AboveAWideLitPlaneIsItsReflectanceTimesTheSky"},
      {"radiosity", "open_solid", "RadiosityOfALeakyRoom.TellsWhereTheLightEscapes"},
      {"meshes", "open_solid", "ElementMeshHard.GapUnderAWallIsTold"},
      {"paths", "mirrors_facing", "MirrorPath.BetweenTwoPureMirrorsEnds"},
      {"radiosity", "memory", "RadiosityThreads.DoNotMatterWhereRowsAreNotKept"},
      {"radiosity", "ten_million", "ElementMeshHard.TooManyPolygonsForTheNumberAllowedIsTold"},
      {"meshes", "ten_million", "ElementMeshHard.TooManyPolygonsForTheNumberAllowedIsTold"},
      {"form_factors", "ray_edges", "AllMethods.WhatIsSeenEdgeOnOrBelowTheHorizonCoversNothing"},
      {"form_factors", "intersecting", "AllMethods.PlanesThatCrossAreCutWhereTheyDo"},
      {"mirrors", "sun_low", "SunThrow.AMirrorEdgeOnAndASunThatIsDownThrowNothing"},
      {"mirrors", "sun_high", "SunThrow.PolygonsLieWhereRaysMeetTheScene"},
      {"mirrors", "ray_edges", "MirrorPicture.PanesThatMeetAtTheMiddleOfAnEdgeLeaveNoGap"},
      {"mirrors", "coplanar", "SunThrow.LightOnCoincidentGroundLandsOnce"},
      {"mirrors", "intersecting", "BeamTree.RectanglesThatCrossOneAnother"},
      {"mirrors", "bright",
       "SunThrow.LightIsKeptThroughEveryMirrorAndItsShareOfThePanelIsThatOfRays"},
      {"mirrors", "mirrors_facing", "ReflectionsCommand.FacingMirrorsBeyondTheDepthAreTold"},
      {"mirrors", "one_triangle", "SunThrow.AFlatMirrorOverFlatGroundHasTheCornersOfTheClosedForm"},
      {"flythrough", "on_edges", "FlyThroughFile.NoSampleOfASurfaceShowsTheBackground"},
      {"flythrough", "off_wall", "FlyThroughFile.TenCentimetresFromAFacadeThereAreNoHoles"},
      {"flythrough", "memory", "FlyThroughFile.ThreadsAndMemoryDoNotChangeItsBits"},
      {"readers", "open_solid", "CityJson.OpenShellIsToldWithItsObject"},
      {"readers", "bright", "Obj.KdIsTheReflectanceAndIsBroughtDownTo09"},
  };
  return kTests;
}

}  // namespace

std::vector<Cell> other_cells() {
  std::vector<Cell> cells;
  for (const Reason& reason : reasons()) {
    for (const std::string& method : reason.methods) {
      for (const std::string& hazard : reason.hazards) {
        cells.push_back({method, hazard, {}, {}, reason.why});
      }
    }
  }
  for (const Elsewhere& cell : tested_elsewhere()) {
    cells.push_back({cell.method, cell.hazard, {}, cell.test, {}});
  }
  return cells;
}

}  // namespace tenku::stability
