// The fields that a schema names and those that documents have, as paths: viewport.crop.x. Arrays add nothing to a path, nor
// does a document's points: what is within are records, as those of a stream are.
const below = (path, key) => (path === "" ? (key === "points" ? "" : key) : `${path}.${key}`);

/// into: a Set. root: the schema that references are in.
export function fieldsOf(schema, root, into, path = "", depth = 0) {
  if (schema === null || typeof schema !== "object" || depth > 30) return into;
  if (Array.isArray(schema)) {
    for (const part of schema) fieldsOf(part, root, into, path, depth + 1);
    return into;
  }
  if (schema.$ref !== undefined) {
    const keys = schema.$ref.split("#")[1].split("/").filter((key) => key !== "");
    fieldsOf(keys.reduce((at, key) => at[key], root), root, into, path, depth + 1);
  }
  for (const key of ["allOf", "anyOf", "oneOf", "then", "else", "items", "prefixItems"])
    fieldsOf(schema[key], root, into, path, depth + 1);
  for (const part of Object.values(schema.dependentSchemas ?? {})) fieldsOf(part, root, into, path, depth + 1);
  for (const [key, part] of Object.entries(schema.properties ?? {})) {
    if (part === false) continue;
    const own = below(path, key);
    if (own !== "") into.add(own);
    fieldsOf(part, root, into, own, depth + 1);
  }
  return into;
}

/// Counts the fields that are there and not null in a Tally.
export function countFields(value, tally, path = "") {
  if (value === null || typeof value !== "object") return;
  for (const [key, part] of Object.entries(value)) {
    const own = Array.isArray(value) ? path : below(path, key);
    if (!Array.isArray(value) && part !== null && own !== "") tally.add(own);
    countFields(part, tally, own);
  }
}
