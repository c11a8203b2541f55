#include <array>

#include "scene/directives.h"

namespace yat {

std::span<const Directive> directives() {
  using B = SceneBuilder;
  constexpr auto kAnywhere = Directive::Where::kAnywhere;
  constexpr auto kOptions = Directive::Where::kOptions;
  constexpr auto kWorld = Directive::Where::kWorld;
  // clang-format off
  static constexpr std::array<Directive, 45> kDirectives = {{
    {"Accelerator", kOptions, "sp", "Accelerator \"type\" parameters", &B::option},
    {"AreaLightSource", kWorld, "sp", "AreaLightSource \"area\" parameters", &B::area_light_source},
    {"AttributeBegin", kWorld, "", "AttributeBegin", &B::attribute_begin},
    {"AttributeEnd", kWorld, "", "AttributeEnd", &B::attribute_end},
    {"Camera", kOptions, "sp", "Camera \"type\" parameters", &B::camera},
    {"ConcatTransform", kAnywhere, "m", "ConcatTransform [16 numbers]", &B::concat_transform},
    {"CoordSysTransform", kAnywhere, "s", "CoordSysTransform \"name\"", &B::coord_sys_transform},
    {"CoordinateSystem", kAnywhere, "s", "CoordinateSystem \"name\"", &B::coordinate_system},
    {"Exterior", kWorld, "s", "Exterior \"volume name\"", &B::current_volume},
    {"Film", kOptions, "sp", "Film \"type\" parameters", &B::option},
    {"Identity", kAnywhere, "", "Identity", &B::identity},
    {"Interior", kWorld, "s", "Interior \"volume name\"", &B::current_volume},
    {"LightGroup", kWorld, "sp", "LightGroup \"name\"", &B::nothing},
    {"LightSource", kWorld, "sp", "LightSource \"type\" parameters", &B::light_source},
    {"LookAt", kAnywhere, "nnnnnnnnn", "LookAt eye_x eye_y eye_z look_x look_y look_z up_x up_y up_z", &B::look_at},
    {"MakeNamedMaterial", kWorld, "sp", "MakeNamedMaterial \"name\" \"string type\" [\"type\"] parameters", &B::make_named_material},
    {"MakeNamedVolume", kWorld, "ssp", "MakeNamedVolume \"name\" \"type\" parameters", &B::make_named_volume},
    {"Material", kWorld, "sp", "Material \"type\" parameters", &B::material},
    {"MotionBegin", kAnywhere, "a", "MotionBegin [times]", &B::motion_begin},
    {"MotionEnd", kAnywhere, "", "MotionEnd", &B::motion_end},
    {"MotionInstance", kWorld, "snns", "MotionInstance \"object\" time time \"coordinate system\"", &B::motion_instance},
    {"NamedMaterial", kWorld, "s", "NamedMaterial \"name\"", &B::named_material},
    {"ObjectBegin", kWorld, "s", "ObjectBegin \"name\"", &B::object_begin},
    {"ObjectEnd", kWorld, "", "ObjectEnd", &B::object_end},
    {"ObjectInstance", kWorld, "s", "ObjectInstance \"name\"", &B::object_instance},
    {"PixelFilter", kOptions, "sp", "PixelFilter \"type\" parameters", &B::option},
    {"PortalInstance", kWorld, "s", "PortalInstance \"name\"", &B::portal},
    {"PortalShape", kWorld, "sp", "PortalShape \"type\" parameters", &B::portal},
    {"Renderer", kOptions, "sp", "Renderer \"type\" parameters", &B::option},
    {"ReverseOrientation", kWorld, "", "ReverseOrientation", &B::reverse_orientation},
    {"Rotate", kAnywhere, "nnnn", "Rotate degrees x y z", &B::rotate},
    {"Sampler", kOptions, "sp", "Sampler \"type\" parameters", &B::option},
    {"Scale", kAnywhere, "nnn", "Scale x y z", &B::scale},
    {"SearchPath", kAnywhere, "s", "SearchPath \"folder\"", &B::nothing},
    {"Shape", kWorld, "sp", "Shape \"type\" parameters", &B::shape},
    {"SurfaceIntegrator", kOptions, "sp", "SurfaceIntegrator \"type\" parameters", &B::option},
    {"Texture", kWorld, "sssp", "Texture \"name\" \"float|color|fresnel\" \"class\" parameters", &B::texture},
    {"Transform", kAnywhere, "m", "Transform [16 numbers]", &B::transform},
    {"TransformBegin", kAnywhere, "", "TransformBegin", &B::transform_begin},
    {"TransformEnd", kAnywhere, "", "TransformEnd", &B::transform_end},
    {"Translate", kAnywhere, "nnn", "Translate x y z", &B::translate},
    {"Volume", kWorld, "sp", "Volume \"type\" parameters", &B::old_volume},
    {"VolumeIntegrator", kOptions, "sp", "VolumeIntegrator \"type\" parameters", &B::option},
    {"WorldBegin", kAnywhere, "", "WorldBegin", &B::world_begin},
    {"WorldEnd", kAnywhere, "", "WorldEnd", &B::world_end},
  }};
  // clang-format on
  return kDirectives;
}

}  // namespace yat
