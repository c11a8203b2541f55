#pragma once
// What kernels read: plain views of the compiled scene. Rows, not pointers; read-only while
// rendering; no containers here, so that kernel sources may include it.
//
// Primitive rows: triangles first, then spheres, planes and the other analytic shapes:
//   [0, triangles)  [triangles, + spheres)  [.., + planes)  [.., + shapes)
// Triangles of shared objects are not among them: a hit there names an instance and a row of
// InstancesView::triangles.

#include <cstdint>

#include "kernels/colour_bands.h"
#include "scene/light_nodes.h"
#include "soa/columns.h"
#include "soa/fields.h"

namespace yat {

// ---- Geometry --------------------------------------------------------------------------------

/// A triangle as shading reads it: one cache line. Vertex order makes (p1-p0)x(p2-p0) the outside.
template <template <class> class Of>
struct TriangleRow {
  Of<float> p0_x, p0_y, p0_z, p1_x, p1_y, p1_z, p2_x, p2_y, p2_z;  ///< scene space [m]
  Of<float> extent;        ///< largest |coordinate| of the three vertices [m]: scale of rounding
  Of<uint32_t> parameter;  ///< row of its material kind's parameter table
  Of<uint32_t> light;      ///< row of the light table, or kNone
  YAT_FIELDS(p0_x, p0_y, p0_z, p1_x, p1_y, p1_z, p2_x, p2_y, p2_z, extent, parameter, light)
};
static_assert(all_fields_listed<TriangleRow>);

/// Vertex normals and texture coordinates of a triangle; read only in bins that have them.
template <template <class> class Of>
struct TriangleVertexRow {
  Of<float> n0_x, n0_y, n0_z, n1_x, n1_y, n1_z, n2_x, n2_y, n2_z;  ///< unit, on the outside's side
  Of<float> u0, v0, u1, v1, u2, v2;
  YAT_FIELDS(n0_x, n0_y, n0_z, n1_x, n1_y, n1_z, n2_x, n2_y, n2_z, u0, v0, u1, v1, u2, v2)
};
static_assert(all_fields_listed<TriangleVertexRow>);

/// A whole sphere. Normals point away from the centre, or towards it where `inward` is 1.
template <template <class> class Of>
struct SphereRow {
  Of<float> center_x, center_y, center_z, radius;  ///< scene space [m], radius > 0
  Of<uint32_t> inward;
  Of<uint32_t> parameter, light;
  Of<uint32_t> occludes;  ///< 1: stops shadow rays; 0: see-through (null material)
  /// The sphere's own x and z axes, unit, in scene space; y = hand * (z cross x), hand 1 or -1.
  Of<float> x_x, x_y, x_z, z_x, z_y, z_z, hand;
  YAT_FIELDS(center_x, center_y, center_z, radius, inward, parameter, light, occludes, x_x, x_y,
             x_z, z_x, z_y, z_z, hand)
};
static_assert(all_fields_listed<SphereRow>);

/// An infinite plane: points p with dot(normal, p) = distance. Never a light.
template <template <class> class Of>
struct PlaneRow {
  Of<float> normal_x, normal_y, normal_z, distance;  ///< unit normal; scene space [m]
  Of<uint32_t> parameter;
  Of<uint32_t> occludes;
  /// u = dot(u_xyz, p) + u_0, v likewise: lengths of object space along two axes of the plane.
  Of<float> u_x, u_y, u_z, u_0, v_x, v_y, v_z, v_0;
  YAT_FIELDS(normal_x, normal_y, normal_z, distance, parameter, occludes, u_x, u_y, u_z, u_0, v_x,
             v_y, v_z, v_0)
};
static_assert(all_fields_listed<PlaneRow>);

/// The other analytic shapes, each in a space of its own of about unit size, its axis of revolution
/// along z, phi from x towards y:
///   quadric  x^2 + y^2 = |g(z)|^2 + e z + s z^2 with g = (a + b z, c + d z): what is left where a
///            line or parabola goes round. Sphere: a = 1, s = -1. Cylinder: a = 1. Cone: a, b.
///            Paraboloid: a = e = 1. Hyperboloid: a, b, c, d, the line that goes round, phi counted
///            from it. z in [z_min, z_max]
///   disk     z = 0, x^2 + y^2 in [a, 1]
///   torus    major radius a, minor radius b, a >= b > 0, a + b = 1; theta, the angle in the tube,
///            0 outermost and growing towards +z, from the angle with cosine c and sine d on by the
///            angle with cosine e and sine s
enum class ShapeKind : uint32_t { kQuadric, kDisk, kTorus, kCount };
inline constexpr uint32_t kShapeKinds = uint32_t(ShapeKind::kCount);

/// An analytic shape and where it is. Rays go by o: p = o * (x - org), exactly as stored; w is the
/// inverse of o, rounded.
///
/// Angles end where the point (cos, sin) of their end says: with a sine below 0 (also of a whole
/// turn, which has a tiny one) the range is more than a half turn.
template <template <class> class Of>
struct ShapeRow {
  Of<float> o_xx, o_xy, o_xz, o_yx, o_yy, o_yz, o_zx, o_zy, o_zz;
  Of<float> org_x, org_y, org_z;  ///< scene space [m]
  Of<float> radius;               ///< of a sphere about org that holds the shape [m]
  Of<float> a, b, c, d, e, s;     ///< see ShapeKind
  Of<float> z_min, z_max;         ///< beyond the surface where it closes by itself
  Of<float> phi_cos, phi_sin;     ///< end of phi
  Of<uint32_t> kind;              ///< ShapeKind
  Of<uint32_t> occludes;          ///< as in SphereRow
  Of<float> w_xx, w_xy, w_xz, w_yx, w_yy, w_yz, w_zx, w_zy, w_zz;
  Of<float> extent;                     ///< largest |coordinate| of the shape, scene space [m]
  Of<float> inner_x, inner_y, inner_z;  ///< scale of rounding along each axis of its own space
  Of<float> u_scale;                    ///< u = phi in turns * u_scale
  Of<float> v_scale, v_offset;          ///< v = what grows along the profile * v_scale + v_offset
  Of<float> z_first, z_last;            ///< quadric: ends of the surface
  Of<float> stretch;                    ///< cube root of |determinant of w|
  Of<uint32_t> inward;                  ///< 1: the normal points to the other side than usual
  Of<uint32_t> parameter, light;
  YAT_FIELDS(o_xx, o_xy, o_xz, o_yx, o_yy, o_yz, o_zx, o_zy, o_zz, org_x, org_y, org_z, radius, a,
             b, c, d, e, s, z_min, z_max, phi_cos, phi_sin, kind, occludes, w_xx, w_xy, w_xz, w_yx,
             w_yy, w_yz, w_zx, w_zy, w_zz, extent, inner_x, inner_y, inner_z, u_scale, v_scale,
             v_offset, z_first, z_last, stretch, inward, parameter, light)
};
static_assert(all_fields_listed<ShapeRow>);

/// Up to eight boxes and what is in them. 256 bytes, aligned to 64.
/// child[i]: bit 31 set = leaf: low 31 bits are (first block << 5 | blocks - 1), at most 32 blocks;
/// bit 31 clear = node row; kNone = no child (its box is empty: min > max, so that no ray enters).
struct alignas(64) TreeNode {
  float min_x[8], min_y[8], min_z[8], max_x[8], max_y[8], max_z[8];  ///< rounded outwards [m]
  uint32_t child[8];
  uint8_t order[8]
               [3];  ///< per direction octant (bit 0: x < 0, 1: y < 0, 2: z < 0): eight 3-bit child
                     ///< indices, nearest first, child k in bits 3k..3k+2 of the little-endian 24
  uint8_t unused[8];
};
static_assert(sizeof(TreeNode) == 256);

/// Rays whose origin has a coordinate beyond this many extents (the largest |coordinate| of the
/// tree's bounds) start again nearer; those from within are traced as they are, and the boxes of
/// the tree are padded for their rounding errors. Cameras that look at a whole scene are within.
inline constexpr float kFarExtents = 7;

/// The tree over all triangles. Blocks hold `block_width` triangles as columns of block_width
/// floats: x0 y0 z0 x1 y1 z1 x2 y2 z2, then the primitive rows (uint32, kNone and NaN vertices in
/// unused places). Node 0 is the root; node_count = 0 means there are no triangles.
struct TreeView {
  const TreeNode* nodes = nullptr;
  const float* blocks = nullptr;              ///< block b starts at b * block_width * 10
  const uint32_t* block_occluders = nullptr;  ///< bit k of word b: triangle k stops shadow rays
  uint32_t node_count = 0;
  uint32_t block_count = 0;
  uint32_t block_width = 16;  ///< 4, 8 or 16
  uint32_t max_depth = 0;     ///< nodes on the longest way from the root to a leaf
  float min[3] = {0, 0, 0}, max[3] = {0, 0, 0};  ///< bounds of all triangles
};

/// Rows [first, end) of a table.
struct RowRange {
  uint32_t first = 0, end = 0;
};

/// The analytic shapes but whole spheres and planes, or those of them that are veils.
struct ShapesView {
  Rows<ShapeRow> rows;          ///< all of the scene, sorted by kind
  RowRange kinds[kShapeKinds];  ///< rows of each kind
  /// Over these shapes and spheres alike: a leaf holds one in its low 31 bits, a row of
  /// GeometryView::spheres, or the number of all spheres + a row of `rows`. node_count = 0: there
  /// are so few that each is tried.
  TreeView tree;
};

struct GeometryView {
  TreeView tree;
  Rows<TriangleRow> triangles;
  Rows<TriangleVertexRow> triangle_vertices;  ///< count = triangles, or 0 if no mesh has them
  Rows<SphereRow> spheres;
  Rows<PlaneRow> planes;
  ShapesView shapes;
  const uint32_t* prim_bin = nullptr;  ///< per primitive row: its bin (Plan)
  bool all_occlude = true;             ///< no see-through triangle: shadow rays need no mask
};

/// What lets a part of the light pass, again: for shadow rays that nothing else stops.
struct VeilView {
  TreeView tree;  ///< over the triangles; leaves hold rows of GeometryView::triangles
  Rows<SphereRow> spheres;
  Rows<PlaneRow> planes;
  uint32_t first_sphere = 0, first_plane = 0;  ///< primitive rows of the first of each
  ShapesView shapes;
};

// ---- Instances -------------------------------------------------------------------------------

/// Where an object is placed. The map is x = w * p + org, w and org exactly as stored: p in object
/// space (origin in the middle of the object), x in scene space. What a ray needs comes first and
/// fills one cache line.
template <template <class> class Of>
struct InstanceRow {
  Of<float> o_xx, o_xy, o_xz, o_yx, o_yy, o_yz, o_zx, o_zy, o_zz;  ///< inverse of w, rounded
  Of<float> org_x, org_y, org_z;                                   ///< scene space [m]
  Of<float> radius;             ///< of a sphere about org that holds the instance [m]
  Of<uint32_t> object;          ///< row of InstancesView::trees
  Of<uint32_t> first_triangle;  ///< of its object, row of InstancesView::triangles
  Of<uint32_t> first_shape;     ///< row of InstancesView::shapes of its object's first shape
  Of<float> w_xx, w_xy, w_xz, w_yx, w_yy, w_yz, w_zx, w_zy, w_zz;
  Of<float> extent;                     ///< largest |coordinate| of the instance, scene space [m]
  Of<float> inner_x, inner_y, inner_z;  ///< scale of rounding along each axis of object space
  YAT_FIELDS(o_xx, o_xy, o_xz, o_yx, o_yy, o_yz, o_zx, o_zy, o_zz, org_x, org_y, org_z, radius,
             object, first_triangle, first_shape, w_xx, w_xy, w_xz, w_yx, w_yy, w_yz, w_zx, w_zy,
             w_zz, extent, inner_x, inner_y, inner_z)
};
static_assert(all_fields_listed<InstanceRow>);

/// Places of fields in an InstanceRow, for whom one field is enough.
inline constexpr uint32_t kObjectWord = 13, kFirstTriangleWord = 14, kFirstShapeWord = 15;

/// What one shape of an object is in an instance. `bin` is the first word of a row.
template <template <class> class Of>
struct InstanceShapeRow {
  Of<uint32_t> bin;
  Of<uint32_t> parameter;  ///< row of its material kind's parameter table
  Of<uint32_t> light;      ///< light row of its first emissive triangle, or kNone
  YAT_FIELDS(bin, parameter, light)
};
static_assert(all_fields_listed<InstanceShapeRow>);

/// Objects whose triangles are stored once, and where they are. In `triangles`, `parameter` is the
/// number of the shape in its object, `light` that of the triangle among the emissive ones of its
/// shape, or kNone. Trees name triangles by their number in the object.
struct InstancesView {
  TreeView top;                     ///< leaves hold an instance row each in their low 31 bits
  const TreeView* trees = nullptr;  ///< one per object, object space
  Rows<InstanceRow> rows;
  Rows<InstanceShapeRow> shapes;
  Rows<TriangleRow> triangles;                ///< object space
  Rows<TriangleVertexRow> triangle_vertices;  ///< count = triangles, or 0
  const uint32_t* triangle_shape = nullptr;   ///< TriangleRow::parameter as a column, for sorting
  uint32_t tree_depth = 0;                    ///< of the deepest object's tree
  bool all_occlude = true;
};

// ---- Lights ----------------------------------------------------------------------------------

/// Kinds of lights. Those from kFirstEnvironment on lie infinitely far away and are found by rays
/// that leave the scene; spots, maps and projections are points that no ray finds.
enum class LightKind : uint32_t {
  kTriangle,
  kSphere,
  kPoint,
  kDistant,
  kRectangle,
  kSpot,
  kPointMap,
  kProjection,
  kShape,
  kConstant,
  kImage,
  kSun,
  kSky,
  kCount
};
inline constexpr uint32_t kFirstEnvironment = uint32_t(LightKind::kConstant);
inline constexpr const char* kLightKindNames[] = {"triangle",
                                                  "sphere",
                                                  "point",
                                                  "distant",
                                                  "rectangle",
                                                  "spot",
                                                  "mapped point",
                                                  "projection",
                                                  "shape",
                                                  "constant environment",
                                                  "image environment",
                                                  "sun",
                                                  "sky"};
static_assert(sizeof(kLightKindNames) / sizeof(*kLightKindNames) == uint32_t(LightKind::kCount));

/// One light: one emissive triangle, two that make a rectangle, a sphere, a point, a direction, an
/// environment. Fields by kind:
///   triangle    a = p0, b = p1 - p0, c = p2 - p0 (b x c points where it shines),
///               extra = area [m2]; in an instance, further = what the rounding of its transform
///               adds to the distance that a ray keeps off it [m]
///   sphere      a = centre, extra = radius, b_x = 1 if it shines inwards
///   point       a = position; a surface at distance d that faces it gets the irradiance
///               radiance / (b_x d^2 + b_y): b = (1, 0) and radiance = intensity [W/sr],
///               or b = (0, 1), no fall-off
///   distant     a = unit direction towards the light; radiance holds the irradiance on a surface
///               that faces it (theta 0), or radiance of a disc with cos(theta) in extra < 1
///   rectangle   a = p0, b = p1 - p0, c = p3 - p0, |b| <= |c|, at right angles (b x c points where
///               it shines), extra = area [m2], further as of triangles
///   spot        a = position, b = unit axis, extra = cosine of the cone,
///               c_x = 1 / (cosine where the falloff begins - extra), finite;
///               radiance holds the intensity on the axis
///   mapped point  a = position, extra = the map's mean, c_x = map row (as bits);
///               radiance holds the mean intensity
///   projection  a = position, c_x = map row (as bits), b_x, b_y = half of the window at
///               distance 1, b_z = flux of a white picture of intensity scale 1,
///               extra = 1 / LuxRender's area
///   shape       a_x = its row of ShapesView::rows, as bits; extra = area [m2]
///   constant    radiance alone
///   image       c_x = map row (as bits), extra = mean luminance, radiance included
///   sun         a = unit direction towards its middle, extra = 1 - cos(its angular radius)
///   sky         c_x = map row, b_x = sky row (as bits), extra = mean luminance, radiance included
template <template <class> class Of>
struct LightRow {
  Of<float> a_x, a_y, a_z, b_x, b_y, b_z, c_x, c_y, c_z;
  Of<float> extra;
  Of<float> radiance_r, radiance_g, radiance_b;  ///< bands
  /// With which sample_lights chooses this row by power; where there is a light tree, only among
  /// those without a place, and 1 for the others.
  Of<float> probability;
  Of<uint32_t> kind;  ///< LightKind
  Of<float> further;  ///< >= 0
  YAT_FIELDS(a_x, a_y, a_z, b_x, b_y, b_z, c_x, c_y, c_z, extra, radiance_r, radiance_g, radiance_b,
             probability, kind, further)
};
static_assert(all_fields_listed<LightRow>);

/// Alias table entry (Walker 1977, Vose 1991): of n equal intervals, interval i gives row i below
/// `threshold`, row `other` above.
template <template <class> class Of>
struct LightChoice {
  Of<float> threshold;
  Of<uint32_t> other;
  YAT_FIELDS(threshold, other)
};
static_assert(all_fields_listed<LightChoice>);

/// How a picture is laid over directions of light space (lxs 6.4); phi from +x towards +y.
enum class MapLayout : uint32_t {
  kLatLong,  ///< s = phi / 2 pi, t = theta / pi from +z: row 0 is the zenith
  kAngular,  ///< a disc about -x
  kCross,    ///< the six sides of a cube in 3 x 4 cells
};

/// A map of a light: its place in the scene, its texels, and the cells that directions are drawn
/// by. Cells divide the lat-long square of light space, whatever the picture's layout. Their lists
/// start at LightView::cells + cells: that of the rows, then that of the columns of each row. A
/// list of n cells has n + 1 cumulative values from 0 to 1, then cell_guides(n) + 1 guides: number
/// k is the last cell that starts at or below k / cell_guides(n).
template <template <class> class Of>
struct LightMapRow {
  Of<float> m_xx, m_xy, m_xz, m_yx, m_yy, m_yz, m_zx, m_zy, m_zz;  ///< scene -> light, |det| = 1
  Of<uint32_t> layout;                                             ///< MapLayout
  Of<uint32_t> texels, width, height;  ///< first texel in LightView::texels, and how many
  Of<uint32_t> cells, columns, rows;   ///< columns = 0: no directions are drawn by this map
  YAT_FIELDS(m_xx, m_xy, m_xz, m_yx, m_yy, m_yz, m_zx, m_zy, m_zz, layout, texels, width, height,
             cells, columns, rows)
};
static_assert(all_fields_listed<LightMapRow>);

/// One guide to four cells. Count: a number or a register of them.
template <class Count>
YAT_INLINE Count cell_guides(const Count& cells) {
  return (cells + Count(3u)) >> 2;
}
/// Words of a list of cells.
template <class Count>
YAT_INLINE Count cell_list_words(const Count& cells) {
  return cells + cell_guides(cells) + Count(2u);
}

/// Words of a texel in LightView::texels: three bands and one that is not used.
inline constexpr uint32_t kTexelWords = 4;

/// A clear sky as a formula (Preetham, Shirley, Smits 1999; lxs 6.5): luminance and chromaticities
/// are q = scale_q (1 + a e^(b / cos theta)) (1 + c e^(d gamma) + e cos^2 gamma), never below 0.
template <template <class> class Of>
struct SkyRow {
  Of<float> a_l, b_l, c_l, d_l, e_l, a_x, b_x, c_x, d_x, e_x, a_y, b_y, c_y, d_y, e_y;
  Of<float> scale_l, scale_x, scale_y;
  Of<float> sun_x, sun_y, sun_z;  ///< unit, light space
  YAT_FIELDS(a_l, b_l, c_l, d_l, e_l, a_x, b_x, c_x, d_x, e_x, a_y, b_y, c_y, d_y, e_y, scale_l,
             scale_x, scale_y, sun_x, sun_y, sun_z)
};
static_assert(all_fields_listed<SkyRow>);
/// Angles to the zenith end there [radians below a right angle]: all that is below has the colour
/// of the horizon.
inline constexpr float kSkyHorizon = .001f;
/// Its exponents are not above this, which only odd constants would have them be.
inline constexpr float kSkyExponent = 40;

/// How the emission of a light with a surface varies: its row's radiance is multiplied by what a
/// texture program (Scene::emission_programs) says at a point, and by a map of the direction.
/// A map's own space is the triangle's: z its normal, x along dp/du; its texels are divided by the
/// cosine to z (kernels/varying_emission.h).
template <template <class> class Of>
struct EmissionRow {
  Of<uint32_t> program;              ///< row of Scene::emission_programs, or kNone
  Of<uint32_t> parameter;            ///< row of the program's constants
  Of<uint32_t> map;                  ///< row of LightView::maps, or kNone
  Of<uint32_t> prim;                 ///< as in Hit
  Of<float> u0, v0, u1, v1, u2, v2;  ///< triangles: texture coordinates of a, a + b, a + c
  YAT_FIELDS(program, parameter, map, prim, u0, v0, u1, v1, u2, v2)
};
static_assert(all_fields_listed<EmissionRow>);

/// Places of fields in an EmissionRow, for whom one field is enough.
inline constexpr uint32_t kEmissionProgramWord = 0, kEmissionParameterWord = 1;

struct LightView {
  Rows<LightRow> rows;  ///< those of environments last
  /// One per light, or none: no light's emission varies.
  Rows<EmissionRow> emission;
  /// Of all lights; where there is a tree, of those without a place only, numbered from 0.
  Rows<LightChoice> choice;
  LightTreeView tree;
  uint32_t kinds = 0;              ///< bit k set: LightKind k is present
  uint32_t first_environment = 0;  ///< row of the first light that rays leaving the scene find
  // What lights with a map need; empty without.
  Rows<LightMapRow> maps;
  Rows<SkyRow> skies;
  const float* texels = nullptr;  ///< kTexelWords each, rows of a map from the top
  const float* cells = nullptr;
  BandBasis basis{};  ///< of lights: bands of colours that kernels compute
};

// ---- Camera ----------------------------------------------------------------------------------

enum class CameraKind : uint32_t {
  kPinhole,
  kThinLens,
  kPolygonLens,
  kOrthographic,
  kEnvironment,
  kFisheye,
  kCount
};
constexpr bool has_lens(CameraKind kind) {
  return kind == CameraKind::kThinLens || kind == CameraKind::kPolygonLens;
}

/// Raster positions (x, y) are in pixels from the top left of the full image.
///   pinhole and lenses   the direction is normalize(corner + x dx + y dy); forward component of
///                        corner is 1, of dx and dy 0
///   orthographic         rays start at corner + x dx + y dy and go along forward
///   environment          with theta = pi y step_y from +dy and phi = 2 pi x step_x: direction
///                        normalize(-sin theta sin phi dx + cos theta dy - sin theta cos phi
///                        forward)
///   fisheye              with (r cos a, r sin a) = (x step_x - 1, 1 - y step_y): at psi = r
///                        half_angle from the axis, in direction a: normalize(sin psi cos a dx +
///                        sin psi sin a dy + cos psi forward); nothing is seen where r > 1
struct CameraView {
  float origin[3];                ///< scene space [m]
  float corner[3], dx[3], dy[3];  ///< scene space
  float forward[3];               ///< view axis; unit, but for environment and fisheye
  float lens_x[3], lens_y[3];     ///< lens axes times radius [m]; 0 for a pinhole
  float focal_distance;           ///< depth of the plane of focus [m]
  float near_depth, far_depth;    ///< hither and yon, along the view axis [m]
  float step_x, step_y;           ///< environment, fisheye: see there
  float half_angle;               ///< fisheye [turns]
  uint32_t blades;                ///< polygon lens: its corners, >= 3
};

enum class FilterKind : uint32_t {
  kBox,      ///< uniform over the radius: no table
  kProduct,  ///< f(x) g(y), nowhere negative: inverted cumulative distributions
  kTable,    ///< any: cumulative distributions over cells, with signs
};

/// Pixel filter as tables for importance sampling, see kernels/camera.h. Offsets in pixels from the
/// pixel centre.
struct FilterView {
  FilterKind kind = FilterKind::kBox;
  float radius_x = 0.5f, radius_y = 0.5f;
  // kProduct: kFilterQuantiles + 1 offsets in units of the radius, from -1 to 1, between which
  // equal shares of the filter lie.
  const float* quantile_x = nullptr;
  const float* quantile_y = nullptr;
  // kTable.
  const float* marginal = nullptr;  ///< kFilterBins + 1 cumulative values over y, 0..1
  const float* conditional =
      nullptr;                  ///< kFilterBins rows of kFilterBins + 1 cumulative values over x
  const float* sign = nullptr;  ///< kFilterBins^2: weight of a sample in the cell (1 where >= 0)
};
inline constexpr uint32_t kFilterBins = 64;
inline constexpr uint32_t kFilterQuantiles = 512;

// ---- Textures --------------------------------------------------------------------------------

/// How a level's texels are stored: tiles of 4 x 4 texels, row by row, rows and columns padded to
/// whole tiles. Channels are r, g, b, a from the low byte or the first word on.
enum class TexelFormat : uint32_t {
  kByte1,   ///< four texels a word
  kByte4,   ///< a word a texel
  kFloat1,  ///< a word a texel
  kFloat4,  ///< four words a texel
};

inline constexpr uint32_t kTexelLevels = 16;

/// All images of the scene.
struct TexelView {
  const uint32_t* words = nullptr;
  const uint32_t* levels = nullptr;  ///< kTexelLevels a row: word where each level begins
};

// ---- Everything ------------------------------------------------------------------------------

/// A parameter table of one material kind; its record type is the kind's (kernels/materials).
struct ParameterView {
  const uint32_t* words = nullptr;
  uint32_t count = 0;
  /// Not null: field f of row i of the chunk is columns[f][i], and `words` is not read. What
  /// textures have made for a chunk comes so.
  const uint32_t* const* columns = nullptr;
};

inline constexpr uint32_t kMaxMaterialKinds = 64;

struct SceneView {
  GeometryView geometry;
  VeilView veils;
  InstancesView instances;  ///< rows.count = 0: none
  LightView lights;
  CameraView camera;
  FilterView filter;
  /// Of a sphere about the scene-space origin that holds the camera and everything but planes [m]:
  /// shadow rays to distant lights end far outside it.
  float radius = 1;
  TexelView texels;
  ParameterView parameters[kMaxMaterialKinds];  ///< indexed by MaterialKind
};

}  // namespace yat
