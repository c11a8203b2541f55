// Camera, film and integrator: conventions of lxs 3 and 4, with exact messages.

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene_builder.h"

namespace yat {
namespace {

class CompileOptionsTest : public SceneTest {
 protected:
  CompileOptionsTest() {
    shape(square());
    light(plugin("point", {}));
  }
  void film(std::vector<Parameter> p) { description.film = plugin("fleximage", std::move(p), 4); }
  void camera(std::vector<Parameter> p) {
    description.camera = plugin("perspective", std::move(p), 2);
  }
  /// World to camera as LookAt makes it (lxs 3.1).
  static Matrix look_at(glm::dvec3 eye, glm::dvec3 look, glm::dvec3 up) {
    const glm::dvec3 d = glm::normalize(look - eye), r = glm::normalize(glm::cross(d, up)),
                     u = glm::cross(r, d);
    return glm::inverse(
        Matrix(glm::dvec4(r, 0), glm::dvec4(u, 0), glm::dvec4(d, 0), glm::dvec4(eye, 1)));
  }
  static glm::dvec3 vec(const float (&v)[3]) { return {double(v[0]), double(v[1]), double(v[2])}; }
  static glm::dvec3 direction(const CameraView& c, double x, double y) {
    return glm::normalize(vec(c.corner) + x * vec(c.dx) + y * vec(c.dy));
  }
  /// Raster position of a world point.
  static glm::dvec2 raster(const Scene& scene, glm::dvec3 world) {
    const CameraView& c = scene.camera;
    const glm::dvec3 to = world - scene.center - vec(c.origin);
    const glm::dvec3 on_plane = to / glm::dot(to, vec(c.forward)) - vec(c.corner);
    return {glm::dot(on_plane, vec(c.dx)) / glm::dot(vec(c.dx), vec(c.dx)),
            glm::dot(on_plane, vec(c.dy)) / glm::dot(vec(c.dy), vec(c.dy))};
  }
};

TEST_F(CompileOptionsTest, DefaultWindowHasTheFovAcrossTheShorterSide) {
  film({integers("xresolution", {200}), integers("yresolution", {100})});
  camera({number("fov", 60)});
  const double t = std::tan(30 * std::numbers::pi / 180);
  Scene scene = compile();
  // Top left: x -2, y +1 (up), looking along +z.
  glm::dvec3 d = direction(scene.camera, 0, 0);
  EXPECT_NEAR(d.x / d.z, -2 * t, 1e-6);
  EXPECT_NEAR(d.y / d.z, t, 1e-6);
  d = direction(scene.camera, 200, 100);
  EXPECT_NEAR(d.x / d.z, 2 * t, 1e-6);
  EXPECT_NEAR(d.y / d.z, -t, 1e-6);
  d = direction(scene.camera, 100, 50);
  EXPECT_NEAR(d.z, 1, 1e-9);
  EXPECT_NEAR(double(scene.camera.corner[2]), 1, 1e-7);

  film({integers("xresolution", {100}), integers("yresolution", {200})});
  scene = compile();
  d = direction(scene.camera, 0, 0);
  EXPECT_NEAR(d.x / d.z, -t, 1e-6);
  EXPECT_NEAR(d.y / d.z, 2 * t, 1e-6);
  EXPECT_SILENT();
}

// Corners of the lamp of a known scene, where the classic renderer shows them.
TEST_F(CompileOptionsTest, FramingAsLuxRender) {
  film({integers("xresolution", {960}), integers("yresolution", {540})});
  camera({number("fov", 49.134342077604479f),
          numbers(ParameterType::kFloat, "screenwindow", {-1, 1, -.5625f, .5625f})});
  description.world_to_camera =
      look_at({0.212302, -10.580390, 2.727224}, {0.212302, -9.580390, 2.727224}, {0, 0, 1});
  const Scene scene = compile();
  const double half = 12.080706596374512 * .050000000745058;
  const glm::dvec3 lamp(0.120537623763084, 2.863173484802246, 5.453133106231689);
  const glm::dvec2 left = raster(scene, lamp + glm::dvec3(-half, -half, 0));
  const glm::dvec2 right = raster(scene, lamp + glm::dvec3(half, -half, 0));
  const glm::dvec2 far_left = raster(scene, lamp + glm::dvec3(-half, half, 0));
  EXPECT_NEAR(left.x, 423.1, .05) << "far corner at " << far_left.x << " " << far_left.y;
  EXPECT_NEAR(left.y, 47.1, .05);
  EXPECT_NEAR(right.x, 521.9, .05);
  EXPECT_NEAR(right.y, 47.1, .05);
  EXPECT_SILENT();
}

TEST_F(CompileOptionsTest, MirroredBeforeLookAtMirrorsThePicture) {
  const Matrix look = look_at({0, -5, 0}, {0, 0, 0}, {0, 0, 1});
  description.world_to_camera = look;
  const glm::dvec2 plain = raster(compile(), {1, 0, .5});
  EXPECT_GT(plain.x, 32) << "world +x is at the right";
  description.world_to_camera = glm::scale(Matrix(1.), glm::dvec3(-1, 1, 1)) * look;
  const glm::dvec2 mirrored = raster(compile(), {1, 0, .5});
  EXPECT_NEAR(mirrored.x, 64 - plain.x, 1e-4);
  EXPECT_NEAR(mirrored.y, plain.y, 1e-4);
}

TEST_F(CompileOptionsTest, DepthsAndLensFollowTheCamerasScale) {
  camera({number("lensradius", .5f), number("focaldistance", 8), number("hither", 2),
          number("yon", 100)});
  // A camera space twice as fine as the world: 8 camera units are 4 m.
  description.world_to_camera = glm::scale(Matrix(1.), glm::dvec3(2.));
  const Scene scene = compile();
  EXPECT_EQ(scene.camera_kind, CameraKind::kThinLens);
  EXPECT_FLOAT_EQ(scene.camera.focal_distance, 4);
  EXPECT_FLOAT_EQ(scene.camera.near_depth, 1);
  EXPECT_FLOAT_EQ(scene.camera.far_depth, 50);
  EXPECT_FLOAT_EQ(scene.camera.lens_x[0], .25f);
  EXPECT_FLOAT_EQ(scene.camera.lens_y[1], .25f);
  EXPECT_FLOAT_EQ(scene.camera.corner[2], 1) << "forward component of corner is 1";
}

TEST_F(CompileOptionsTest, StretchedWindowWarns) {
  camera({numbers(ParameterType::kFloat, "screenwindow", {-1, 1, -.5625f, .5625f})});
  compile();
  EXPECT_SAID(
      "scene.lxs:3:2: warning: the \"screenwindow\" has another aspect ratio than the 64 x 64 "
      "picture, which is therefore stretched vertically 1.78 times");
}

// Nothing moves, so when the shutter is open does not matter.
TEST_F(CompileOptionsTest, ShutterTimesAreAccepted) {
  film({integers("xresolution", {100}), integers("yresolution", {100})});
  camera({number("fov", 60)});
  const glm::dvec3 before = direction(compile().camera, 20, 30);
  camera({number("fov", 60), number("shutteropen", .25f), number("shutterclose", .5f),
          text("shutterdistribution", "uniform")});
  EXPECT_EQ(direction(compile().camera, 20, 30), before);
  EXPECT_EQ(all_said(), "");
}

TEST_F(CompileOptionsTest, CameraErrors) {
  camera({number("fov", 180)});
  EXPECT_EQ(error(),
            "scene.lxs:3:2: error: \"fov\" is 180 degrees, but must be above 0 and below 180");
  camera({number("fov", 0)});
  EXPECT_EQ(error(),
            "scene.lxs:3:2: error: \"fov\" is 0 degrees, but must be above 0 and below 180");
  description.camera = plugin("realistic", {}, 2);
  EXPECT_EQ(error(),
            "scene.lxs:2:1: error: camera \"realistic\" is not supported: use \"perspective\"");
  description.camera = plugin("perspectve", {}, 2);
  EXPECT_EQ(error(),
            "scene.lxs:2:1: error: camera \"perspectve\" is not supported (did you mean "
            "\"perspective\"?): use \"perspective\"");
  camera({});
  description.world_to_camera = glm::scale(Matrix(1.), glm::dvec3(1, 0, 1));
  EXPECT_EQ(error(),
            "scene.lxs:2:1: error: the camera's transform cannot be inverted: check the "
            "LookAt, Scale and Transform before it");
  description.camera.reset();
  EXPECT_EQ(error(),
            "error: the scene has no Camera: add LookAt and Camera \"perspective\" before "
            "WorldBegin");
}

TEST_F(CompileOptionsTest, FilmDefaultsAreLuxRenders) {
  description.film.reset();
  const Scene scene = compile();
  EXPECT_EQ(scene.film.width, 800u);
  EXPECT_EQ(scene.film.height, 600u);
  EXPECT_EQ(scene.film.tone_map, ToneMap::kAutoLinear);
  EXPECT_EQ(scene.film.gamma, 2.2f);
  EXPECT_EQ(scene.film.halt_spp, -1);
}

TEST_F(CompileOptionsTest, FilmIsRead) {
  film({integers("xresolution", {100}), integers("yresolution", {50}), number("gamma", 1.8f),
        text("tonemapkernel", "reinhard"), number("reinhard_burn", 7), text("filename", "pic"),
        text("ldr_clamp_method", "hue"), integers("haltspp", {64}),
        numbers(ParameterType::kFloat, "colorspace_white", {.31f, .33f}),
        numbers(ParameterType::kFloat, "cropwindow", {.25f, .5f, 0, .331f}),
        text("write_png", "true", ParameterType::kBool), integers("outlierrejection_k", {2})});
  const FilmSettings f = compile().film;
  EXPECT_EQ(f.tone_map, ToneMap::kReinhard);
  EXPECT_EQ(f.reinhard_burn, 7);
  EXPECT_EQ(f.gamma, 1.8f);
  EXPECT_EQ(f.filename, "pic");
  EXPECT_EQ(f.clamp, ClampMethod::kHue);
  EXPECT_EQ(f.halt_spp, 64);
  EXPECT_EQ(f.white[1], .33f);
  EXPECT_EQ(f.crop_x0, 25u);
  EXPECT_EQ(f.crop_x1, 50u);
  EXPECT_EQ(f.crop_y0, 0u);
  EXPECT_EQ(f.crop_y1, 17u) << "ceil(50 * .331)";
  EXPECT_SILENT();
}

TEST_F(CompileOptionsTest, FilmSaysWhichFilesAreWrittenAndHow) {
  // LuxRender's default.
  film({});
  Scene scene = compile();
  ASSERT_EQ(scene.film.files.size(), 1u);
  EXPECT_EQ(scene.film.files[0].extension, ".png");
  EXPECT_FALSE(scene.film.files[0].deep);
  const auto flag = [](std::string name, std::string value) {
    return text(std::move(name), std::move(value), ParameterType::kBool);
  };
  film({flag("write_png", "false"), flag("write_png_16bit", "true"), flag("write_tga", "true"),
        text("write_tga_channels", "YA"), flag("write_exr", "true"),
        flag("write_exr_halftype", "false"), flag("write_exr_applyimaging", "false"),
        text("write_exr_compressiontype", "None"), flag("write_exr_ZBuf", "false")});
  scene = compile();
  ASSERT_EQ(scene.film.files.size(), 2u);
  EXPECT_EQ(scene.film.files[0].extension, ".tga");
  EXPECT_EQ(scene.film.files[0].channels, PictureFile::Channels::kYA);
  EXPECT_EQ(scene.film.files[1].extension, ".exr");
  EXPECT_FALSE(scene.film.files[1].half);
  EXPECT_FALSE(scene.film.files[1].tone_mapped);
  EXPECT_EQ(scene.film.files[1].compression, "none");
  EXPECT_SILENT();
}

TEST_F(CompileOptionsTest, FalseColorsAreRead) {
  film({text("tonemapkernel", "falsecolors"), text("false_method", "log3"),
        text("false_colorscale", "lmk"), number("false_min", .5f), number("false_max", 80)});
  const FilmSettings f = compile().film;
  EXPECT_EQ(f.tone_map, ToneMap::kFalseColors);
  EXPECT_EQ(f.false_method, FalseColorMethod::kLog3);
  EXPECT_EQ(f.false_scale, FalseColorScale::kLmk);
  EXPECT_EQ(f.false_min, .5f);
  EXPECT_EQ(f.false_max, 80);
  EXPECT_SILENT();
}

TEST_F(CompileOptionsTest, SamplersAreWhatIsNearest) {
  const auto sampler = [&](const char* type) {
    description.sampler = plugin(type, {}, 12);
    return compile().sampler;
  };
  EXPECT_EQ(sampler("metropolis"), SamplerKind::kSobol);
  EXPECT_SAID(
      "scene.lxs:12:1: note: Sampler \"metropolis\": yat's nearest is \"sobol\" (--sampler)");
  EXPECT_EQ(sampler("random"), SamplerKind::kIndependent);
  EXPECT_EQ(sampler("cmj"), SamplerKind::kCorrelatedMultiJittered);
  EXPECT_EQ(sampler("nrook"), SamplerKind::kSobol);
  EXPECT_SAID(
      "scene.lxs:12:1: warning: unknown Sampler \"nrook\" (did you mean \"nrooks\"?): \"sobol\" is "
      "used");
  description.dialect = Dialect::kYart;
  EXPECT_EQ(sampler("random"), SamplerKind::kSobol);
}

TEST_F(CompileOptionsTest, OptionsOverrideTheFilm) {
  options.width = 320;
  options.height = 200;
  options.crop_given = true;
  options.crop[0] = options.crop[2] = .5f;
  const FilmSettings f = compile().film;
  EXPECT_EQ(f.width, 320u);
  EXPECT_EQ(f.crop_x0, 160u);
  EXPECT_EQ(f.crop_height(), 100u);
}

TEST_F(CompileOptionsTest, FilmTrouble) {
  film({text("tonemapkernel", "reinhart"), integers("dither", {1}), text("hdr_filename", "x"),
        text("tonemappkernel", "linear"), number("gamma", 0)});
  const Scene scene = compile();
  EXPECT_EQ(scene.film.tone_map, ToneMap::kAutoLinear);
  EXPECT_EQ(scene.film.gamma, 2.2f);
  EXPECT_SAID(
      "scene.lxs:5:2: warning: unknown tonemapkernel \"reinhart\" (did you mean "
      "\"reinhard\"?): \"autolinear\" is used");
  EXPECT_SAID(
      "scene.lxs:7:2: warning: obsolete Film parameters are not used: \"hdr_filename\", "
      "\"dither\"");
  EXPECT_SAID(
      "scene.lxs:8:2: warning: parameter \"string tonemappkernel\" of film \"fleximage\" is not "
      "used (did you mean \"tonemapkernel\"?)");
  EXPECT_SAID("scene.lxs:9:2: warning: \"gamma\" is 0, but must be above 0: 2.2 is used");
}

TEST_F(CompileOptionsTest, FilmErrors) {
  film({integers("xresolution", {0})});
  EXPECT_EQ(error(),
            "scene.lxs:4:1: error: the film is 0 x 600 pixels: both must be from 1 to 65535");
  film({numbers(ParameterType::kFloat, "cropwindow", {.5f, .5f, 0, 1})});
  EXPECT_EQ(error(),
            "scene.lxs:5:2: error: the crop window 0.5 0.5 0 1 is empty or not within 0 to 1 "
            "(x0 x1 y0 y1)");
  description.film = plugin("image", {}, 4);
  EXPECT_EQ(error(), "scene.lxs:4:1: error: unknown film \"image\": use \"fleximage\"");
}

TEST_F(CompileOptionsTest, Integrators) {
  EXPECT_EQ(compile().max_depth, 16);
  description.integrator = plugin("path", {integers("maxdepth", {5})});
  EXPECT_EQ(compile().max_depth, 5);
  description.integrator = plugin("bidirectional", {integers("eyedepth", {8})});
  EXPECT_EQ(compile().max_depth, 16);
  description.integrator = plugin("bidirectional", {integers("eyedepth", {40})});
  EXPECT_EQ(compile().max_depth, 40);
  description.integrator = plugin("directlighting", {});
  EXPECT_EQ(compile().max_depth, 5);
  EXPECT_TRUE(compile().direct_only);
  EXPECT_SILENT();
  description.integrator = plugin("sppm", {});
  EXPECT_EQ(compile().max_depth, 16);
  EXPECT_SAID(
      "scene.lxs:10:1: warning: unsupported integrator \"sppm\": \"path\" with maxdepth 16 is "
      "used");
  description.integrator = plugin("pth", {});
  compile();
  EXPECT_SAID(
      "scene.lxs:10:1: warning: unknown integrator \"pth\" (did you mean \"path\"?): \"path\" "
      "with maxdepth 16 is used");
}

TEST_F(CompileOptionsTest, EmptyScenes) {
  description.shapes.clear();
  EXPECT_EQ(error(), "error: the scene is empty: it has no Shape");
  shape(square()).material = material(plugin("null", {}));
  EXPECT_EQ(error(), "error: nothing to render: none of the 1 shapes can be seen");
}

TEST_F(CompileOptionsTest, NoLightIsAWarning) {
  description.lights.clear();
  const Scene scene = compile();
  EXPECT_EQ(scene.lights.size(), 0u);
  EXPECT_EQ(scene.light_kinds, 0u);
  EXPECT_SAID("warning: the scene has no light that can be used: the picture will be black");
}

TEST_F(CompileOptionsTest, AcceleratorAndOptionChooseTheTree) {
  const auto shape_of = [&](TreeChoice choice) {
    options.tree = choice;
    return compile().tree.statistics.shape;
  };
  EXPECT_EQ(shape_of(TreeChoice::kFromScene), TreeShape::kObjects);
  EXPECT_EQ(shape_of(TreeChoice::kKd), TreeShape::kKd);
  for (const char* name : {"kdtree", "tabreckdtree", "unsafekdtree"}) {
    description.accelerator = plugin(name, {number("emptybonus", .5f)}, 12);
    EXPECT_EQ(shape_of(TreeChoice::kFromScene), TreeShape::kKd) << name;
    EXPECT_EQ(shape_of(TreeChoice::kAuto), TreeShape::kObjects) << name;
  }
  EXPECT_SILENT();
  description.accelerator = plugin("qbvh", {integers("maxprimsperleaf", {4})}, 12);
  EXPECT_EQ(shape_of(TreeChoice::kFromScene), TreeShape::kObjects);
  EXPECT_SAID(
      "scene.lxs:12:1: note: Accelerator \"qbvh\": yat builds the tree that suits the triangles");
}

}  // namespace
}  // namespace yat
