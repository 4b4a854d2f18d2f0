#include "input/typed_camera.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "camera/camera.hpp"
#include "input/adjusted.hpp"
#include "input/camera_fields.hpp"
#include "input/geodetic.hpp"
#include "input/typed_value.hpp"
#include "input/viewport_fields.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace viewproj::cmd {

using namespace detail;
namespace {

using Json = nlohmann::json;
using Names = std::vector<std::string_view>;

bool contains(const Names& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool includes(const Names& all, const Names& some) {
  return std::all_of(some.begin(), some.end(), [&](std::string_view name) { return contains(all, name); });
}

bool isOfAWay(const ObjectForm& form, const Field& field) {
  return std::any_of(form.ways.begin(), form.ways.end(), [&](const Way& way) { return way.uses(field); });
}

/// The form's field of that name, or null.
const Field* fieldOf(const ObjectForm& form, std::string_view name) {
  const auto found =
      std::find_if(form.fields.begin(), form.fields.end(), [&](const Field* field) { return field->name == name; });
  return found == form.fields.end() ? nullptr : *found;
}

/// Options that may stand together: those of one way, and those of no way.
Names optionsOf(const ObjectForm& form, const Way* way) {
  Names names;
  for (const Field* field : form.fields)
    if (!field->option.empty() && (!way || way->uses(*field) || !isOfAWay(form, *field)))
      names.push_back(field->option);
  return names;
}

struct Variant {
  const ProjectionType* type;
  Names options, keys;
};

std::vector<Variant> lensVariants() {
  std::vector<Variant> all;
  for (const ProjectionType& type : projectionTypes()) {
    const auto add = [&](const Way* way) {
      Variant variant{&type, optionsOf(type.form, way), {}};
      for (const Field* field : way ? way->keys : type.form.required) variant.keys.push_back(field->option);
      if (!type.option.empty()) variant.options.push_back(type.option);
      all.push_back(variant);
    };
    for (const Way& way : type.form.ways) add(&way);
    if (type.form.ways.empty()) add(nullptr);
  }
  return all;
}

/// Throws where no set has all of the names, with as few of them as tell it.
void requireTogether(const std::vector<Names>& sets, const Names& names) {
  const auto go = [&](const Names& some) {
    return std::any_of(sets.begin(), sets.end(), [&](const Names& set) { return includes(set, some); });
  };
  if (go(names)) return;
  Names apart = names;
  for (std::size_t i = 0; i < names.size() && apart.size() > 2; ++i)
    for (std::size_t j = i + 1; j < names.size(); ++j)
      if (const Names pair{names[i], names[j]}; !go(pair) && apart.size() > 2) apart = pair;
  for (std::size_t i = 0; apart.size() > 2 && i < apart.size();) {
    Names fewer = apart;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    if (go(fewer))
      ++i;
    else
      apart = fewer;
  }
  throw UsageError(together(apart) + " do not go together; leave out one of them");
}

/// Of every projection: near, far, shift.
bool isOfEveryType(std::string_view field) {
  const auto types = projectionTypes();
  return std::all_of(types.begin(), types.end(), [&](const ProjectionType& type) { return type.form.has(field); });
}

ObjectReader rootOf(const Document& document) { return {document, document.root(), {}}; }

/// Throws where --set gives what is to be replaced.
void requireNotSet(const Document& document, const Path& path, std::string_view option) {
  if (document.isSet(dotted(path)))
    throw UsageError(std::string(option) + " takes the place of what --set " + dotted(path) +
                     " gives; leave out one of them");
}

void drop(Document& document, const ObjectReader& object, const Field& field, std::string_view option) {
  while (object.has(field)) {
    const Path path = object.pathOf(field);
    requireNotSet(document, path, option);
    document.drop(path);
  }
}

/// base: where the field's object is.
void give(Document& document, const Path& base, const Field& field, const Json& value, std::string_view option) {
  Path path = base;
  path.emplace_back(field.name);
  requireNotSet(document, path, option);
  document.give(path, value, std::string(option));
}

double numberOf(const Json& value) { return value.get<double>(); }

/// Of fx, fy, cx and cy what no option gives stays the file's.
void keepIntrinsics(Document& fields, const CameraFile& camera) {
  if (!camera.projection || !camera.viewport || parts(*camera.projection).orthographic) return;
  const ScreenMap map = screenMap(parts(*camera.projection), *camera.viewport);
  const Path base{std::string(field::projection)};
  const ObjectReader given = *rootOf(fields).object(field::projection);
  for (const auto& [field, number] :
       {std::pair(&field::fx, map.scaleX.hi), std::pair(&field::fy, std::fabs(map.scaleY.hi)),
        std::pair(&field::cx, rounded(map.centerX)), std::pair(&field::cy, rounded(map.centerY))})
    if (!given.has(*field)) give(fields, base, *field, number, "");
}

[[noreturn]] void failToWiden(const std::string& camera) {
  throw UsageError(
      "--aspect alone does not widen the view of " + camera +
      ", which is given by its edges or focal lengths, or is off the middle; --fov-y with it gives another "
      "view");
}

const Way* wayOf(const ObjectForm& form, const ObjectReader& object) {
  const auto holds = [&](const Field* key) { return object.has(*key); };
  for (const Way& way : form.ways)
    if (std::all_of(way.keys.begin(), way.keys.end(), holds)) return &way;
  for (const Way& way : form.ways)
    if (std::any_of(way.keys.begin(), way.keys.end(), holds)) return &way;
  return nullptr;
}

}  // namespace

std::vector<CameraOption> cameraOptions() {
  std::vector<CameraOption> options;
  const auto add = [&](const CameraOption& option) {
    if (!option.name.empty() && std::none_of(options.begin(), options.end(),
                                             [&](const CameraOption& other) { return other.name == option.name; }))
      options.push_back(option);
  };
  for (const Field* field : field::camera.fields) add({field->option, field, nullptr, false});
  for (const ProjectionType& type : projectionTypes()) {
    for (const Field* field : type.form.fields) add({field->option, field, nullptr, true});
    add({type.option, nullptr, &type, true});
  }
  return options;
}

void TypedCamera::add(const CameraOption& option, const std::string& text) {
  Given given{option, nullptr};
  if (option.field) {
    // Rows that share an option may have other forms: what one of them may be is for the reader to say.
    ValueForm form = option.field->form;
    for (const ProjectionType& type : projectionTypes())
      for (const Field* field : type.form.fields)
        if (option.ofLens && field->option == option.name && field->form != form) form = ValueForm::number;
    given.value = std::make_shared<const Json>(typedValue(form, std::string(option.name), text, option.field->hint));
  }
  given_.push_back(std::move(given));
}

std::vector<std::string_view> TypedCamera::names() const {
  Names names;
  for (const Given& given : given_)
    if (!contains(names, given.option.name)) names.push_back(given.option.name);
  return names;
}

TypedCamera TypedCamera::without(std::string_view option) const {
  TypedCamera rest = *this;
  std::erase_if(rest.given_, [&](const Given& given) { return given.option.name == option; });
  return rest;
}

bool TypedCamera::hasPlace() const {
  return std::any_of(given_.begin(), given_.end(),
                     [](const Given& given) { return given.value && given.value->is_object(); });
}

std::vector<TypedCamera::Given> TypedCamera::of(bool lens) const {
  std::vector<Given> some;
  for (const Given& given : given_)
    if (given.option.ofLens == lens) some.push_back(given);
  return some;
}

bool TypedCamera::replacesPose() const {
  const std::vector<Given> pose = of(false);
  return pose.size() > 1 && std::any_of(pose.begin(), pose.end(),
                                        [](const Given& given) { return given.option.field == &field::position; });
}

bool TypedCamera::replacesLens() const {
  return std::any_of(given_.begin(), given_.end(), [](const Given& given) {
    return given.option.ofLens && !(given.option.field && isOfEveryType(*given.option.field));
  });
}

std::optional<double> TypedCamera::aspect() const {
  for (const Given& given : given_)
    if (given.option.field == &field::aspect) return numberOf(*given.value);
  return std::nullopt;
}

void TypedCamera::assumeOpening(bool hasViewport) {
  const auto isLens = [](const Given& given) { return given.option.ofLens; };
  const auto isOpening = [](const Given& given) {
    return given.option.ofLens && given.option.field && !isOfEveryType(*given.option.field);
  };
  if (std::none_of(given_.begin(), given_.end(), isLens) || std::any_of(given_.begin(), given_.end(), isOpening))
    return;
  const auto isType = [](const Given& given) { return given.option.type != nullptr; };
  const bool orthographic = std::any_of(given_.begin(), given_.end(), isType);
  for (const CameraOption& option : cameraOptions())
    if (option.name == (orthographic ? field::orthoHeight : field::fovY).option ||
        (option.name == field::aspect.option && !hasViewport))
      add(option, "60");
}

void TypedCamera::requireConsistent() const {
  if (given_.size() < 2) return;
  Names pose, lens;
  for (const Given& given : given_) (given.option.ofLens ? lens : pose).push_back(given.option.name);
  std::vector<Names> poses, lenses;
  for (const Way& way : field::camera.ways) poses.push_back(optionsOf(field::camera, &way));
  for (const Variant& variant : lensVariants()) lenses.push_back(variant.options);
  requireTogether(poses, pose);
  requireTogether(lenses, lens);
}

bool TypedCamera::shapesByAspectAlone(const std::vector<Given>& lens) {
  return std::all_of(lens.begin(), lens.end(), [](const Given& given) {
    return given.option.field && (given.option.field == &field::aspect || isOfEveryType(*given.option.field));
  });
}

const ProjectionType& TypedCamera::typeFor(const std::vector<Given>& lens) const {
  Names names;
  for (const Given& given : lens) names.push_back(given.option.name);
  const std::vector<Variant> variants = lensVariants();
  const ProjectionType* type = nullptr;
  for (const Variant& variant : variants) {
    if (!includes(variant.options, names)) continue;
    const bool keyed = std::any_of(names.begin(), names.end(), [&](std::string_view name) {
      return contains(variant.keys, name) && !isOfEveryType(name.substr(2));
    });
    if (keyed) return *variant.type;
    if (!type) type = variant.type;
  }
  return *type;
}

void TypedCamera::mergeInto(Document& document, CameraReading& reading,
                            const std::function<CameraFile()>& unchanged) const {
  mergePose(document, reading, unchanged);
  mergeLens(document, reading, unchanged);
}

void TypedCamera::mergePose(Document& document, CameraReading& reading,
                            const std::function<CameraFile()>& unchanged) const {
  const std::vector<Given> pose = of(false);
  if (pose.empty()) return;
  const ObjectReader root = rootOf(document);
  const ObjectForm& form = field::camera;
  const auto usesAll = [&](const Way& way) {
    return std::all_of(pose.begin(), pose.end(), [&](const Given& given) { return way.uses(*given.option.field); });
  };
  const auto hasKey = [&](const Way& way) {
    return std::any_of(way.keys.begin(), way.keys.end(), [&](const Field* key) {
      return std::any_of(pose.begin(), pose.end(), [&](const Given& given) { return given.option.field == key; });
    });
  };
  const auto isGiven = [&](const Field& field) {
    return std::any_of(pose.begin(), pose.end(), [&](const Given& given) { return given.option.field == &field; });
  };
  const Way* const own = wayOf(form, root);
  if (own && !usesAll(*own)) {
    const auto next =
        std::find_if(form.ways.begin(), form.ways.end(), [&](const Way& way) { return usesAll(way) && hasKey(way); });
    if (next == form.ways.end() && pose.size() == 1 && isGiven(field::position)) {
      // A matrix, of which the turn is kept.
      const Json& eye = *pose.front().value;
      if (!eye.is_array())
        throw UsageError(
            "--position: a place needs a direction beside it, since the file's is a matrix: --heading, "
            "--target or --direction");
      reading.eye = Vec3{numberOf(eye[0]), numberOf(eye[1]), numberOf(eye[2])};
      return;
    }
    if (next != form.ways.end()) {
      std::optional<Vec3> eye;
      if (!isGiven(field::position) && !root.has(field::position)) eye = unchanged().pose->eye();
      for (const Field* field : form.fields)
        if (isOfAWay(form, *field) && !next->uses(*field)) drop(document, root, *field, pose.front().option.name);
      if (eye) document.give({std::string(field::position)}, Json::array({eye->x, eye->y, eye->z}), "");
    }
  }
  for (const Given& given : pose) {
    drop(document, root, *given.option.field, given.option.name);
    give(document, {}, *given.option.field, *given.value, given.option.name);
  }
}

void TypedCamera::mergeLens(Document& document, CameraReading& reading,
                            const std::function<CameraFile()>& unchanged) const {
  const std::vector<Given> lens = of(true);
  if (lens.empty()) return;
  const Path base{std::string(field::projection)};
  const ObjectReader root = rootOf(document);
  const bool hadOne = root.has(field::projection);
  if (!hadOne) document.give(base, Json::object(), "");
  const ObjectReader fields = *root.object(field::projection);

  const ProjectionType* own = nullptr;
  if (fields.isString(field::type))
    for (const ProjectionType& type : projectionTypes())
      if (*fields.text(field::type) == type.name) own = &type;
  if (hadOne && !own && (fields.has(field::type) || !document.isTyped())) return;  // which the reader complains about
  const auto holds = [&](const ProjectionType& type) {
    return std::all_of(lens.begin(), lens.end(), [&](const Given& given) {
      return given.option.type ? given.option.type == &type : type.form.has(*given.option.field);
    });
  };
  const ProjectionType& type = own && holds(*own) ? *own : typeFor(lens);
  if (hadOne && &type != own && shapesByAspectAlone(lens)) failToWiden(document.name());
  const bool sameType = own == &type;
  const std::string_view first = lens.front().option.name;

  std::vector<const Field*> typed, shaping;  // the type's rows; those beyond near, far and shift
  for (const Given& given : lens)
    if (given.option.field) {
      typed.push_back(fieldOf(type.form, *given.option.field));
      if (!isOfEveryType(*typed.back())) shaping.push_back(typed.back());
    }
  // Edges of the file are on its near plane.
  if (sameType && type.name == kFrustum && typed.size() > shaping.size() && !shaping.empty() && shaping.size() < 4 &&
      std::find(typed.begin(), typed.end(), &field::zNear) != typed.end())
    throw UsageError(
        "--near moves the plane that the frustum's edges are on; give all of --left, --right, --bottom and --top "
        "with it, or none");
  const Way* const was = sameType ? wayOf(type.form, fields) : nullptr;
  const auto usesAll = [&](const Way& way) {
    return std::all_of(shaping.begin(), shaping.end(), [&](const Field* field) { return way.uses(*field); });
  };
  const Way* next = nullptr;  // that takes the place of what the file has
  if (!(was && usesAll(*was)))
    for (const Way& way : type.form.ways) {
      const auto isThere = [&](const Field* field) {
        return std::find(shaping.begin(), shaping.end(), field) != shaping.end() || (sameType && fields.has(*field));
      };
      const bool keyed = std::any_of(way.keys.begin(), way.keys.end(), [&](const Field* key) {
        return std::find(shaping.begin(), shaping.end(), key) != shaping.end();
      });
      if (!keyed || !usesAll(way)) continue;
      const bool whole = std::all_of(way.keys.begin(), way.keys.end(), isThere) &&
                         std::all_of(way.with.begin(), way.with.end(), isThere);
      if (whole || !next) next = &way;
      if (whole) break;
    }
  const bool replaces = !sameType || next;
  // The shape of the picture stays, where nothing else says it.
  const bool takesAspect = next && next->uses(field::aspect);
  std::optional<double> shape;
  if (hadOne && replaces && takesAspect && !fields.has(field::aspect) && !root.has(field::viewport) &&
      std::find(typed.begin(), typed.end(), &field::aspect) == typed.end())
    if (const CameraFile file = unchanged(); file.projection) shape = windowAspect(parts(*file.projection)).hi;

  if (own && !sameType) {
    for (const Field* field : own->form.fields)
      if (!isOfEveryType(*field) && !(takesAspect && field == &field::aspect)) drop(document, fields, *field, first);
  } else if (next) {
    for (const Field* field : type.form.fields)
      if (isOfAWay(type.form, *field) && !next->uses(*field)) drop(document, fields, *field, first);
  }
  if (!sameType) give(document, base, field::type, type.name, first);
  if (shape) give(document, base, field::aspect, *shape, first);

  // Edges on the near plane, whose opening stays where only that moves.
  const bool isOnNear =
      sameType && !replaces && shaping.empty() && (type.name == kFrustum || fields.has(field::nearWidth));
  for (const Given& given : lens) {
    if (!given.option.field) continue;
    const Field& field = *fieldOf(type.form, *given.option.field);
    if (&field == &field::zNear && isOnNear && fields.has(field)) {
      requireNotSet(document, fields.pathOf(field), given.option.name);
      reading.near = numberOf(*given.value);
      document.label(fields.pathOf(field), std::string(given.option.name));
      continue;
    }
    give(document, base, field, *given.value, given.option.name);
  }
}

CameraFile TypedCamera::over(const CameraFile& camera, const Document& document, const CameraReading& reading) const {
  CameraFile file = camera;
  Document fields(Document::Typed{}, camera.name);
  const ObjectReader root = rootOf(fields);
  // What stands for the words of a convention that a file of another form does not have.
  const ConventionPreset* preset = &conventionPresets().front();
  for (const ConventionPreset& other : conventionPresets())
    if (preset->convention != camera.convention && other.convention == camera.convention) preset = &other;
  const std::vector<Given> pose = of(false), lens = of(true);
  const auto locate = [&](const auto& read) {
    try {
      read();
    } catch (const CameraError& e) {
      fields.fail(pathInCamera(fields, e.field()), e.message());
    }
  };
  if (pose.size() == 1 && pose.front().option.field == &field::position && camera.pose &&
      pose.front().value->is_array()) {
    const Json& eye = *pose.front().value;
    locate([&] {
      file.pose =
          movedTo(*camera.pose, {numberOf(eye[0]), numberOf(eye[1]), numberOf(eye[2])}, camera.convention.world);
    });
  } else if (!pose.empty()) {
    if (camera.pose) {
      const Vec3 eye = camera.pose->eye();
      fields.give({std::string(field::position)}, Json::array({eye.x, eye.y, eye.z}), "");
    }
    for (const Given& given : pose) give(fields, {}, *given.option.field, *given.value, given.option.name);
    locate([&] { file.pose = readPose(root, camera.convention, *preset); });
    file.worldIsEcef = worldIsEcef(root);
  }
  if (lens.empty()) return file;

  std::optional<double> near, far;
  std::optional<std::pair<double, double>> shift;
  std::optional<double> aspect;
  bool replaces = false;
  for (const Given& given : lens) {
    const Field* const field = given.option.field;
    if (field == &field::zNear)
      near = numberOf(*given.value);
    else if (field == &field::zFar)
      far = numberOf(*given.value);
    else if (field == &field::shift)
      shift = {numberOf((*given.value)[0]), numberOf((*given.value)[1])};
    else if (field == &field::aspect && camera.projection)
      aspect = numberOf(*given.value);
    else
      replaces = true;
  }
  for (const Given& given : lens)
    if (given.option.field)
      fields.label({std::string(field::projection), std::string(*given.option.field)}, std::string(given.option.name));
  if (!replaces && camera.projection) {
    if (aspect && !camera.tookAspect) {
      if (!isCentred(*camera.projection)) failToWiden(document.name());
      try {
        file.projection = withAspect(*camera.projection, *aspect);
      } catch (const CameraError& e) {
        fields.fail({std::string(field::projection), std::string(field::aspect)}, e.message());
      }
    }
    if (aspect && camera.viewport && !reading.allowStretch)
      requireShape(windowAspect(parts(*file.projection)), *camera.viewport,
                   ObjectReader(fields, fields.root(), {std::string(field::projection), std::string(field::aspect)}));
    locate([&] {
      if (near || far) file.projection = withRange(*file.projection, near, far);
      if (shift) file.projection = shifted(*file.projection, shift->first, shift->second);
    });
    return file;
  }
  if (const auto tile = rootOf(document).find(field::viewport); tile && tile->is_object() && tile->contains("crop"))
    throw UsageError(std::string(lens.front().option.name) + " is of the whole picture, and viewport.crop of " +
                     document.name() + " leaves a tile of it");
  const Path base{std::string(field::projection)};
  const ProjectionType& type = typeFor(lens);
  give(fields, base, field::type, type.name, "");
  if (camera.projection) {
    const ProjectionParts& was = parts(*camera.projection);
    give(fields, base, field::zNear, was.near, "");
    if (std::isfinite(was.far)) give(fields, base, field::zFar, was.far, "");
  }
  for (const Given& given : lens)
    if (given.option.field) give(fields, base, *given.option.field, *given.value, given.option.name);
  if (type.name == kIntrinsics) keepIntrinsics(fields, camera);
  const ObjectReader projection = *root.object(field::projection);
  const Way* const way = wayOf(type.form, projection);
  if (way && way->uses(field::aspect) && !projection.has(field::aspect) && camera.projection) {
    const DoubleDouble shape = windowAspect(parts(*camera.projection));
    if (!camera.viewport) give(fields, base, field::aspect, shape.hi, "");
  }
  locate([&] { file.projection = readProjection(projection, type, camera.viewport, reading.allowStretch); });
  return file;
}

}  // namespace viewproj::cmd
