// A type of Cyclone DDS whose samples are bytes: encoded messages pass through DDS as they stand in a log.
//
// Samples for dds_write() and dds_take() are std::string with the CDR bytes and the four before them that
// name the encoding. Cyclone DDS neither reads nor changes them, so it needs no description of the type; only
// its name has to be the same on both sides. There are no keys.
#pragma once

#include <dds/dds.h>

#include <string>

namespace outrider {

/// Creates a topic of bytes; both names are those on the wire. Returns the error of Cyclone DDS, below 0, if
/// it refuses.
dds_entity_t create_cdr_topic(dds_entity_t participant, const std::string& topic, const std::string& type);

}  // namespace outrider
