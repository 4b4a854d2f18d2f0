// What a reader asks for and a schema cannot say, told by the reader's message. Each stands in the schema's description.

/// Whether an array of points makes a document or is a field of a record, only the order of keys tells.
function hasPointsBehind(message, value) {
  return Array.isArray(value?.points) && Object.keys(value)[0] !== "points";
}

export const kRules = {
  camera: {
    "far is above near": /projection\.far: must be greater than near/,
    "a text is in the range of a number":
      /expected a number or "16\/9" \(is "|must be (an angle between 0 and 180|from -90 to 90) degrees.*\(is "|aspect: must be above 0 \(is "/,
    "edges are in order": /projection\.(right|top): must be greater than (left|bottom)/,
    "a ps2 depth range has two ends": (message, value) =>
      value.projection?.type === "ps2" && /viewport\.depthRange: must span more than one value/.test(message),
    "the shape fits the viewport's": /times as wide as high, but the viewport/,
    "target is not the eye": /: is the camera's own position/,
    "up is not along the view": /up: is parallel to the viewing direction|target: is straight above or below the camera/,
    "a matrix is a rotation": /has a 3x3 part that is not a rotation/,
    "a matrix has the world's handedness": /(worldFromCamera|cameraFromWorld): is a (mirroring|rotation) of camera axes/,
    // An aspect that the file has itself would stand behind the message; so does a width that is above 0 until halved.
    "no number leaves the range of doubles":
      /makes a window too (small or too )?large|has a window too small for doubles|a[xy]: times scrz leaves|aspect: must be a finite number above 0$|(width|height): must be above 0 \(is \d[\d.]*e-\d+\)|must be between -?[\d.]+e-?\d+ and [\d.]+e\d+|times the viewport's size away|must span more than 1\.2e-271|is too small a part of|leaves less than 2e-10/,
    "no key is given twice": /the key '.*' is given twice/,
  },
  scene: {
    "a text is in the range of a number": /must be from -90 to 90 degrees.*\(is "/,
    "max is not below min": /box\.max: must not be below min/,
    "a height is not below -1000000": /height: must not be below -1000000 metres/,
    "no key is given twice": /the key '.*' is given twice/,
  },
  points: {
    "a record has one point or shape": /has two (points|shapes)|has both/,
    "points is a document's first key": hasPointsBehind,
    "three numbers without names need a camera elsewhere": /three numbers without names/,
    "max is not below min": /max must not be below min/,
    "no key is given twice": /has (the field )?'?\w+'? twice|has the field '.*' twice/,
    "no number leaves the range of doubles": /number overflow/,
  },
  shapes: {
    "a record has one point or shape": /has two (points|shapes)|has both/,
    "points is a document's first key": hasPointsBehind,
    "three numbers without names need a camera elsewhere": /three numbers without names/,
    "max is not below min": /max must not be below min/,
    "no key is given twice": /has (the field )?'?\w+'? twice|has the field '.*' twice/,
    "no number leaves the range of doubles": /number overflow|beyond the range of doubles/,
  },
  pixels: {
    "the parts of a point come from one set of names": /[A-Z]\w*: '.*' is not a finite number/,
    "points is a document's first key": hasPointsBehind,
    "the point is in front of the eye": /lies beyond infinity|is not in front of the eye/,
    "no key is given twice": /has (the field )?'?\w+'? twice|has the field '.*' twice/,
    "no number leaves the range of doubles": /number overflow/,
  },
};

/// The name of the rule by which the verdicts differ, or nothing. message: the reader's, empty where it accepts.
export function ruleOf(kind, message, value) {
  for (const [name, rule] of Object.entries(kRules[kind]))
    if (rule instanceof RegExp ? rule.test(message) : rule(message, value)) return name;
  return undefined;
}
