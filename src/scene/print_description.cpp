// The way back to text. What was interleaved in the file comes in groups here: textures, materials,
// lights, shapes and objects, instances. So that every use still means the same row, names are made
// unique; lamps, which have no names, are kept open in blocks while shapes use them.

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/graphics_state.h"
#include "scene/parse.h"
#include "scene/statement.h"

namespace yat {
namespace {

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      (out += '\\') += c;
    else if (c == '\n')
      out += "\\n";
    else if (c == '\r')
      out += "\\r";
    else
      out += c;
  }
  return out + '"';
}

/// Names for rows, each different from all others: its own where that is free.
class UniqueNames {
 public:
  void add(const std::string& name) { originals_.insert(name); }
  std::string make(std::string_view name, std::string_view otherwise) {
    std::string result(name.empty() ? otherwise : name);
    if (!name.empty() && used_.insert(result).second) return result;
    for (uint32_t n = 2;; ++n) {
      std::string candidate = fmt::format("{} {}", result, n);
      if (!originals_.count(candidate) && used_.insert(candidate).second) return candidate;
    }
  }
  bool is_used(const std::string& name) const { return used_.count(name) != 0; }

 private:
  std::set<std::string> originals_, used_;
};

class Printer {
 public:
  explicit Printer(const Description& description) : d_(description) {
    for (const TextureEntry& t : d_.textures) texture_names_.add(t.name);
    for (const MaterialEntry& m : d_.materials) material_names_.add(m.name);
    for (const VolumeEntry& v : d_.volumes) volume_names_.add(v.name);
    for (const ObjectEntry& o : d_.objects) object_names_.add(o.name);
    for (const TextureEntry& t : d_.textures) textures_.push_back(texture_names_.make(t.name, "_"));
    for (const MaterialEntry& m : d_.materials)
      materials_.push_back(material_names_.make(m.name, "inline"));
    for (const VolumeEntry& v : d_.volumes) volumes_.push_back(volume_names_.make(v.name, "_"));
    for (const ObjectEntry& o : d_.objects) objects_.push_back(object_names_.make(o.name, "_"));
  }

  std::string print() {
    options();
    line("WorldBegin");
    for (size_t i = 0; i < d_.textures.size(); ++i) texture(d_.textures[i], textures_[i]);
    for (size_t i = 0; i < d_.materials.size(); ++i) {
      const Plugin& plugin = d_.materials[i].plugin;
      line("MakeNamedMaterial {} \"string type\" [{}]", quoted(materials_[i]), quoted(plugin.type));
      parameters(plugin.parameters);
    }
    for (size_t i = 0; i < d_.volumes.size(); ++i) {
      const Plugin& plugin = d_.volumes[i].plugin;
      line("MakeNamedVolume {} {}", quoted(volumes_[i]), quoted(plugin.type));
      parameters(plugin.parameters);
    }
    for (const LightEntry& light : d_.lights) {
      begin_placed(light.to_world);
      plugin_line("LightSource", light.plugin);
      line("AttributeEnd");
    }
    shapes();
    for (const InstanceEntry& instance : d_.instances) {
      begin_placed(instance.to_world);
      select_material(instance.material);
      line("ObjectInstance {}", quoted(objects_[instance.object]));
      line("AttributeEnd");
    }
    line("WorldEnd");
    return std::move(out_);
  }

 private:
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
    out_ += '\n';
  }

  void transform(const Matrix& m) {
    out_ += "Transform [";
    for (int i = 0; i < 16; ++i)
      fmt::format_to(std::back_inserter(out_), "{}{}", i == 0 ? "" : " ", m[i / 4][i % 4]);
    out_ += "]\n";
  }

  void begin_placed(const Matrix& to_world) {
    line("AttributeBegin");
    if (to_world != Matrix(1.0)) transform(to_world);
  }

  void select_material(uint32_t row) {
    if (row != kNoRow) line("NamedMaterial {}", quoted(materials_[row]));
  }

  std::string texture_reference(const Parameter& parameter) const {
    if (parameter.texture != kNoRow) return textures_[parameter.texture];
    // What was not visible there must not be found now, when all textures come first.
    std::string name = parameter.strings[0];
    while (in_world_ && texture_names_.is_used(name)) name += " (not visible)";
    return name;
  }

  void parameters(const std::vector<Parameter>& list) {
    for (const Parameter& p : list) {
      out_ += "  " + quoted(fmt::format("{} {}", parameter_type_name(p.type), p.name)) + " [";
      const char* gap = "";
      const auto add = [&](const auto& value) {
        fmt::format_to(std::back_inserter(out_), "{}{}", std::exchange(gap, " "), value);
      };
      if (p.type == ParameterType::kTexture)
        add(quoted(texture_reference(p)));
      else if (p.material != kNoRow)
        add(quoted(materials_[p.material]));
      else
        for (const std::string& s : p.strings) add(quoted(s));
      for (const float x : p.floats) add(x);
      for (const int32_t i : p.integers) add(i);
      out_ += "]\n";
    }
  }

  void plugin_line(std::string_view directive, const Plugin& plugin) {
    line("{} {}", directive, quoted(plugin.type));
    parameters(plugin.parameters);
  }

  void options() {
    const auto option = [&](std::string_view directive, const std::optional<Plugin>& plugin) {
      if (plugin) plugin_line(directive, *plugin);
    };
    option("Renderer", d_.renderer);
    option("Sampler", d_.sampler);
    option("Accelerator", d_.accelerator);
    option("SurfaceIntegrator", d_.integrator);
    option("VolumeIntegrator", d_.volume_integrator);
    option("PixelFilter", d_.filter);
    option("Film", d_.film);
    if (d_.camera && d_.world_to_camera != Matrix(1.0)) transform(d_.world_to_camera);
    option("Camera", d_.camera);
    in_world_ = true;
  }

  void texture(const TextureEntry& entry, const std::string& name) {
    // Without a block: the name would go with it.
    if (entry.to_world != Matrix(1.0)) transform(entry.to_world);
    line("Texture {} {} {}", quoted(name), quoted(entry.kind), quoted(entry.plugin.type));
    parameters(entry.plugin.parameters);
    if (entry.to_world != Matrix(1.0)) line("Identity");
  }

  // Lamps. A lamp that several shapes share is one row, so it is printed once, in a block that is
  // open until its last shape. Blocks nest because they did in the file that was read.

  void push_lamp(uint32_t row) {
    line("AttributeBegin");
    plugin_line("AreaLightSource", d_.area_lights[row].plugin);
    open_lamps_.push_back(row);
  }
  void pop_lamp() {
    line("AttributeEnd");
    open_lamps_.pop_back();
  }
  /// Prints the lamps up to this row that are not printed yet; those with a shape from `shape` on
  /// stay open.
  void print_lamps(uint32_t end_row, size_t shape) {
    for (; next_lamp_ < end_row; ++next_lamp_) {
      push_lamp(next_lamp_);
      if (lamp_end_[next_lamp_] <= shape) pop_lamp();
    }
  }
  /// Makes this the current lamp for shape number `shape`.
  void select_lamp(uint32_t row, size_t shape) {
    const size_t floor = object_ == kNoRow ? 0 : lamps_outside_;
    while (open_lamps_.size() > floor && open_lamps_.back() != row &&
           (row == kNoRow || row < next_lamp_ || lamp_end_[open_lamps_.back()] <= shape))
      pop_lamp();
    if (row == kNoRow || (!open_lamps_.empty() && open_lamps_.back() == row)) return;
    if (row < next_lamp_)
      push_lamp(row);  // not nested as a file would: as a row of its own
    else
      print_lamps(row + 1, shape);
  }

  void begin_object(uint32_t row, size_t first) {
    for (; next_object_ < row; ++next_object_) empty_object(next_object_);
    size_t end = first;
    uint32_t newest = 0;  // one more than the newest lamp in the object
    while (end < d_.shapes.size() && d_.shapes[end].object == row) {
      if (d_.shapes[end].area_light != kNoRow)
        newest = std::max(newest, d_.shapes[end].area_light + 1);
      ++end;
    }
    while (!open_lamps_.empty() && lamp_end_[open_lamps_.back()] <= first) pop_lamp();
    // Lamps that outlive the object began before it, and so did all lamps before them.
    while (newest > next_lamp_ && lamp_end_[newest - 1] <= end) --newest;
    if (newest > next_lamp_) print_lamps(newest, first);
    line("ObjectBegin {}", quoted(objects_[row]));
    next_object_ = row + 1;
    lamps_outside_ = open_lamps_.size();
    object_ = row;
  }
  void end_object() {
    if (object_ == kNoRow) return;
    while (open_lamps_.size() > lamps_outside_) pop_lamp();
    line("ObjectEnd");
    object_ = kNoRow;
  }
  void empty_object(uint32_t row) { line("ObjectBegin {}\nObjectEnd", quoted(objects_[row])); }

  void shapes() {
    lamp_end_.assign(d_.area_lights.size(), 0);
    for (size_t i = 0; i < d_.shapes.size(); ++i)
      if (d_.shapes[i].area_light != kNoRow) lamp_end_[d_.shapes[i].area_light] = i + 1;
    for (size_t i = 0; i < d_.shapes.size(); ++i) {
      const ShapeEntry& shape = d_.shapes[i];
      if (shape.object != object_) {
        end_object();
        if (shape.object != kNoRow) begin_object(shape.object, i);
      }
      select_lamp(shape.area_light, i);
      begin_placed(shape.to_world);
      if (shape.reverse_orientation) line("ReverseOrientation");
      select_material(shape.material);
      if (shape.interior != kNoRow) line("Interior {}", quoted(volumes_[shape.interior]));
      if (shape.exterior != kNoRow) line("Exterior {}", quoted(volumes_[shape.exterior]));
      plugin_line("Shape", shape.plugin);
      line("AttributeEnd");
    }
    end_object();
    while (!open_lamps_.empty()) pop_lamp();
    print_lamps(uint32_t(d_.area_lights.size()), d_.shapes.size());
    for (; next_object_ < d_.objects.size(); ++next_object_) empty_object(next_object_);
  }

  const Description& d_;
  std::string out_;
  UniqueNames texture_names_, material_names_, volume_names_, object_names_;
  /// Printed name of each row.
  std::vector<std::string> textures_, materials_, volumes_, objects_;
  bool in_world_ = false;
  std::vector<size_t> lamp_end_;  ///< number of the shape behind the last one that uses the lamp
  std::vector<uint32_t> open_lamps_;
  uint32_t next_lamp_ = 0, next_object_ = 0;
  uint32_t object_ = kNoRow;
  size_t lamps_outside_ = 0;  ///< open lamps that began before the current object
};

}  // namespace

std::string print_description(const Description& description) {
  return Printer(description).print();
}

}  // namespace yat
