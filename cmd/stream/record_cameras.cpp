#include "stream/record_cameras.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "camera/patch.hpp"
#include "camera/read_pose.hpp"
#include "formats/pose_chain.hpp"
#include "formats/unread.hpp"
#include "output/output_file.hpp"
#include "output/record_writer.hpp"
#include "text/csv.hpp"
#include "text/error.hpp"
#include "text/json_text.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/utf8.hpp"
#include "viewproj/lens.hpp"

namespace viewproj::cmd {
namespace {

/// The values of a record's fields, as a row of a table has them.
Json rowOf(const RecordView& record, std::span<const std::size_t> fields) {
  Json row = Json::object();
  for (const std::size_t field : fields) {
    const std::string_view text = record.values[field];
    Json& value = row[record.schema->names[field]];
    if (record.schema->form == Form::csv)
      value = trimmed(csvValue(text));
    else if (const auto fault = parseJson(std::string(text), value))
      throw RecordError(record.offset(field), fault->message);
  }
  return row;
}

std::size_t placeOf(const RecordView& record, std::size_t field) {
  return isBinary(record.schema->form) ? field * bytesOf(record.schema->form) : record.offset(field);
}

}  // namespace

std::size_t cameraFieldOf(const std::string& name, const RecordView& record, const char* option) {
  const Schema& schema = *record.schema;
  const bool isCsv = schema.form == Form::csv, hasNames = !schema.isArray && (!isCsv || schema.hasHeader);
  if (hasNames)
    if (const auto field = schema.find(name)) return *field;
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  const bool isNumber = error == std::errc() && end == name.data() + name.size() && number > 0;
  if (isNumber && (!hasNames || isCsv) && number <= schema.size) return number - 1;
  const std::string what = isCsv ? "column " : schema.isArray ? "number " : "field ";
  throw RecordError(0, "has no " + what + visible(name) + ", which " + option + " names" +
                           (hasNames ? fieldsNote(schema) : "; fields without names have numbers, from 1"));
}

std::string cameraNameAt(const RecordView& record, std::size_t field) {
  const Form form = record.schema->form;
  if (isBinary(form)) return formatNumber(binaryNumbers(form, record.text)[field]);
  const std::string_view value = record.values[field];
  const bool isName = form != Form::json || value.starts_with('"') || beginsNumber(value[0]);
  return isName ? std::string(trimmed(plainText(record, field))) : "";
}

RecordCamera::RecordCamera(const Camera& of) : camera(of), convention(of.convention()) {
  if (!lensOf(camera)) frustum = viewFrustum(camera);
}

RecordCamera::RecordCamera(const CameraFile& file, std::string named) : RecordCamera(makeCamera(file)) {
  name = std::move(named);
  convention = file.convention;
  worldIsEcef = file.worldIsEcef;
  knowsUp = cmd::knowsUp(file);
  lacksSize = file.lacksSize;
  if (lacksSize) frustum.reset();
}

RecordCameras::RecordCameras(const Camera& one) {
  kept_.emplace_back().camera.emplace(one);
  all_.push_back(&*kept_.front().camera);
}

RecordCameras::RecordCameras(const CameraFile& one) : first_(one), worldIsEcef_(one.worldIsEcef) {
  kept_.emplace_back().camera.emplace(one, "");
  all_.push_back(&*kept_.front().camera);
}

RecordCameras::RecordCameras(Setup setup) : setup_(std::move(setup)) {
  const CameraSet& cameras = *setup_.cameras;
  if (setup_.choice == CameraChoice::own) {
    base_ = cameras.document(setup_.picked.front());
    isUnplaced_ =
        cameras.mayLackPose(setup_.picked.front()) && !hasPose(*base_.root) && !base_.labels.contains("position");
    worldIsEcef_ = worldOf(readValues(base_)) == World::ecef;
    return;
  }
  std::optional<InputError> fault;
  for (const std::size_t which : setup_.picked) {
    try {
      CameraFile file = readCamera(cameras.document(which), setup_.reading);
      (void)makeCamera(file);
      first_ = std::move(file);
      firstWhich_ = which;
      break;
    } catch (const InputError& e) {
      if (!fault) fault = e;
      if (setup_.choice == CameraChoice::each) break;
    }
  }
  if (!first_) throw InputError(*fault);
  worldIsEcef_ = first_->worldIsEcef;
  kept_.resize(cameras.size());
  isPicked_.resize(cameras.size());
  for (const std::size_t which : setup_.picked) isPicked_[which] = true;
  if (setup_.choice == CameraChoice::each)
    for (const std::size_t which : setup_.picked) all_.push_back(&cameraOf(which));
}

std::vector<std::string> RecordCameras::notes() const {
  if (!first_) return {};
  std::vector<std::string> notes = first_->notes;
  if (const std::string unread = setup_.cameras->unreadOf(firstWhich_); !unread.empty())
    notes.push_back(setup_.cameras->fileOf(firstWhich_) + ": not read: " + unread);
  return notes;
}

void RecordCameras::requireWorld(const CameraFile& file) const {
  if (file.worldIsEcef == worldIsEcef_) return;
  if (setup_.choice == CameraChoice::own)
    throw InputError(file.worldIsEcef ? "its camera is on the Earth; --set world=ecef says that all are"
                                      : "its camera is not on the Earth, as world \"ecef\" says");
  throw InputError(file.name + (file.worldIsEcef ? ": is on the Earth, and " : ": is not on the Earth, as ") +
                   first_->name + (file.worldIsEcef ? " is not" : " is"));
}

const RecordCamera& RecordCameras::cameraOf(std::size_t which) const {
  Kept& kept = kept_[which];
  std::call_once(kept.once, [&] {
    try {
      const CameraFile file = readCamera(setup_.cameras->document(which), setup_.reading);
      requireWorld(file);
      setup_.require(file);
      kept.camera.emplace(file, setup_.cameras->pickOf(which));
    } catch (const std::runtime_error& e) {
      kept.fault = e.what();
    }
  });
  if (!kept.camera) throw InputError(kept.fault);
  return *kept.camera;
}

void RecordCameras::noteReading(const CameraColumns& columns, const std::vector<std::string>& unread) const {
  const bool statesAxes = base_.root->contains("cameraAxes") || valueAt(*base_.root, "convention.preset") ||
                          valueAt(*base_.root, "convention.view");
  const bool isOfPixels = valueAt(*base_.root, "projection.fx") || columns.hasFocalPixels();
  if (columns.lacksAxes() && columns.hasRotation() && isOfPixels && !statesAxes) note(kAxesNote);
  if (columns.hasTranslation()) note(kTranslationNote);
  if (columns.hasTurn() && (base_.root->contains("worldFromCamera") || base_.root->contains("cameraFromWorld")))
    note(
        "the poses of records replace that of the camera; --world-from-camera TABLE --world-from-camera POSE of the "
        "camera, with --camera-by, multiplies them");
  for (const std::string& each : columns.notes()) note(each);
  if (!unread.empty()) note("the camera in a record: not read: " + joined(unread));
}

RecordCameraFields RecordCameras::locate(const RecordView& record, const NumberPlan& plan) const {
  if (setup_.choice == CameraChoice::named) return {{cameraFieldOf(setup_.field, record)}};
  if (setup_.choice != CameraChoice::own) return {};
  const Schema& schema = *record.schema;
  if (schema.isArray || (schema.form == Form::csv && !schema.hasHeader))
    throw RecordError(0, "has numbers without names, and --camera-in-record needs the names of a camera's fields");
  Json names = Json::object();
  const auto isUsed = [&](std::size_t i) {
    return std::any_of(plan.fields.begin(), plan.fields.end(),
                       [&](const NumberField& used) { return used.field == i; });
  };
  for (std::size_t i = 0; i < schema.names.size(); ++i)
    if (!isUsed(i)) names[schema.names[i]];
  const bool hasNorth = worldIsEcef_ || base_.root->value("world", "") != "";
  const auto columns = std::make_shared<const CameraColumns>(names, true, hasNorth);
  RecordCameraFields all{{}, columns};
  std::vector<std::string> unread;
  for (std::size_t i = 0; i < schema.names.size(); ++i) {
    const std::string& name = schema.names[i];
    if (isUsed(i)) continue;
    if (columns->reads(name))
      all.fields.push_back(i);
    else if (mayBeOfCamera(name))
      unread.push_back(visible(name));
  }
  if (all.fields.empty())
    throw RecordError(0, "has no field of a camera, such as heading, target.x or fovY" + fieldsNote(schema));
  std::call_once(*readingNoted_, [&] { noteReading(*columns, unread); });
  return all;
}

std::size_t cameraNamed(const CameraSet& cameras, const std::vector<bool>& isPicked, const RecordView& record,
                        std::size_t field, std::string_view name) {
  const auto which = cameras.find(name);
  if (which && isPicked[*which]) return *which;
  const std::string label = record.schema->isArray ? "" : visible(record.schema->names[field]) + ": ";
  throw RecordError(placeOf(record, field),
                    label + (name.empty() ? "names no camera"
                                          : "no camera of " + cameras.name() + " is called " + inQuotes(name) +
                                                ", or several are; viewproj info lists them"));
}

const RecordCamera& RecordCameras::cameraNamed(const RecordView& record, std::size_t field,
                                               std::string_view name) const {
  const std::size_t which = cmd::cameraNamed(*setup_.cameras, isPicked_, record, field, name);
  try {
    return cameraOf(which);
  } catch (const InputError& e) {
    throw RecordError(placeOf(record, field), e.what());
  }
}

RecordCamera RecordCameras::ownCamera(const RecordView& record, const RecordCameraFields& of) const {
  Document row{"its camera", std::make_shared<Json>(rowOf(record, of.fields))};
  try {
    row.root = std::make_shared<Json>(of.columns->documentOf(Node(row)));
    normalize(row);
    Document document = base_;
    document.root = std::make_shared<Json>(*base_.root);
    document.name = row.name;
    // A place that no file states is no place for a turn that is stated.
    if (isUnplaced_ && of.columns->hasTurn()) document.root->erase("position");
    layOver(document, *row.root);
    const CameraFile file = readCamera(document, setup_.reading);
    requireWorld(file);
    setup_.require(file);
    return {file, ""};
  } catch (const RecordError&) {
    throw;
  } catch (const std::runtime_error& e) {
    throw RecordError(record.offset(of.fields.front()), e.what());
  }
}

std::span<const RecordCamera* const> CamerasOfBatch::find(const RecordView& record, const RecordCameraFields& of) {
  const CameraChoice choice = cameras_.setup_.choice;
  if (choice == CameraChoice::one || choice == CameraChoice::each) return cameras_.all_;
  text_.clear();
  if (choice == CameraChoice::own)
    for (const std::size_t field : of.fields) {
      text_ += record.values[field];
      text_ += '\n';
      text_ += record.schema->names[field];
      text_ += '\n';
    }
  else
    text_ = cameraNameAt(record, of.fields.front());
  if (!last_ || text_ != lastText_) {
    last_ = nullptr;
    if (choice == CameraChoice::named)
      last_ = &cameras_.cameraNamed(record, of.fields.front(), text_);
    else
      last_ = &own_.emplace_back(cameras_.ownCamera(record, of));
    lastText_ = text_;
  }
  return {&last_, 1};
}

void CamerasOfBatch::clear() {
  while (own_.size() > 1) own_.pop_front();  // the last one may be the next record's too
}

}  // namespace viewproj::cmd
