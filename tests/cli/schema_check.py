"""Checks values against JSON schemas, for the words of JSON schema (draft 2020-12) that ours use."""
import functools
import json

from tool import SOURCE

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "integer": int, "number": (int, float),
         "null": type(None)}
KNOWN = {"$schema", "$id", "$defs", "$ref", "title", "description", "type", "properties", "required",
         "additionalProperties", "items", "enum", "const", "minimum", "maximum", "minItems", "maxItems", "oneOf"}


@functools.cache
def schemas():
    return json.loads((SOURCE / "docs/server.schema.json").read_text())


def has_type(value, name):
    return isinstance(value, TYPES[name]) and (name == "boolean" or not isinstance(value, bool))


def refusals(schema, value, where="$"):
    """Returns where and how the value differs from the schema; nothing when it keeps it."""
    assert set(schema) <= KNOWN, set(schema) - KNOWN
    if "$ref" in schema:
        prefix = "#/$defs/"
        assert schema["$ref"].startswith(prefix), schema["$ref"]
        return refusals(schemas()["$defs"][schema["$ref"][len(prefix):]], value, where)
    if "oneOf" in schema:
        found = [refusals(one, value, where) for one in schema["oneOf"]]
        good = [one for one in found if not one]
        return [] if len(good) == 1 else [f"{where}: keeps {len(good)} of {len(found)} forms: {found}"]
    types = schema.get("type", list(TYPES))
    if not any(has_type(value, name) for name in ([types] if isinstance(types, str) else types)):
        return [f"{where}: not of type {types}: {str(value)[:60]}"]
    if "const" in schema and value != schema["const"]:
        return [f"{where}: not {schema['const']}"]
    if "enum" in schema and value not in schema["enum"]:
        return [f"{where}: {value} is none of {schema['enum']}"]
    found = []
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        if not schema.get("minimum", value) <= value <= schema.get("maximum", value):
            found.append(f"{where}: {value} is out of range")
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            found.append(f"{where}: {len(value)} entries")
        for i, one in enumerate(value):
            found += refusals(schema.get("items", {}), one, f"{where}[{i}]")
    if isinstance(value, dict):
        found += [f"{where}.{name}: missing" for name in schema.get("required", []) if name not in value]
        for name, one in value.items():
            inner = schema.get("properties", {}).get(name, schema.get("additionalProperties", {}))
            found += [f"{where}.{name}: unknown"] if inner is False else refusals(inner, one, f"{where}.{name}")
    return found
