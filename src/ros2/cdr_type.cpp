#include "cdr_type.hpp"

#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/q_radmin.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <span>

namespace outrider {
namespace {

/// An encoded sample, which Cyclone DDS counts references to.
struct CdrSample : ddsi_serdata {
  CdrSample(const ddsi_sertype* of, ddsi_serdata_kind what) : ddsi_serdata{} {
    ddsi_serdata_init(this, of, what);
  }
  /// Cyclone DDS reads up to a whole number of four bytes.
  void set(std::size_t size) {
    size_ = size;
    bytes.assign((size + 3) / 4 * 4, '\0');
  }
  [[nodiscard]] std::size_t size() const { return size_; }

  std::string bytes;

 private:
  std::size_t size_ = 0;
};

const CdrSample& sample_of(const ddsi_serdata* data) { return *static_cast<const CdrSample*>(data); }

bool same_key(const ddsi_serdata*, const ddsi_serdata*) { return true; }

std::uint32_t size_of(const ddsi_serdata* data) { return static_cast<std::uint32_t>(sample_of(data).size()); }

/// Joins what came over the network; its parts may overlap.
ddsi_serdata* from_fragments(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* part,
                             std::size_t size) {
  auto sample = std::make_unique<CdrSample>(type, kind);
  sample->set(size);
  std::size_t known = 0;
  for (; part != nullptr && known < size; part = part->nextfrag) {
    if (part->maxp1 <= known) continue;
    const unsigned char* from = NN_RMSG_PAYLOADOFF(part->rmsg, NN_RDATA_PAYLOAD_OFF(part));
    const std::size_t end = std::min<std::size_t>(part->maxp1, size);
    std::memcpy(sample->bytes.data() + known, from + (known - part->min), end - known);
    known = end;
  }
  return sample.release();
}

ddsi_serdata* from_pieces(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                          const ddsrt_iovec_t* pieces, std::size_t size) {
  auto sample = std::make_unique<CdrSample>(type, kind);
  sample->set(size);
  std::size_t known = 0;
  for (const ddsrt_iovec_t& piece : std::span(pieces, static_cast<std::size_t>(count))) {
    const std::size_t part = std::min<std::size_t>(piece.iov_len, size - known);
    std::memcpy(sample->bytes.data() + known, piece.iov_base, part);
    known += part;
  }
  return sample.release();
}

ddsi_serdata* from_keyhash(const ddsi_sertype* type, const ddsi_keyhash*) {
  return std::make_unique<CdrSample>(type, SDK_KEY).release();
}

ddsi_serdata* from_sample(const ddsi_sertype* type, ddsi_serdata_kind kind, const void* bytes) {
  auto sample = std::make_unique<CdrSample>(type, kind);
  if (kind != SDK_DATA) return sample.release();
  const auto& from = *static_cast<const std::string*>(bytes);
  sample->set(from.size());
  std::ranges::copy(from, sample->bytes.begin());
  return sample.release();
}

void copy_bytes(const ddsi_serdata* data, std::size_t offset, std::size_t size, void* to) {
  std::memcpy(to, sample_of(data).bytes.data() + offset, size);
}

ddsi_serdata* lend_bytes(const ddsi_serdata* data, std::size_t offset, std::size_t size, ddsrt_iovec_t* to) {
  to->iov_base = const_cast<char*>(sample_of(data).bytes.data()) + offset;
  to->iov_len = size;
  return ddsi_serdata_ref(data);
}

void give_back(ddsi_serdata* data, const ddsrt_iovec_t*) { ddsi_serdata_unref(data); }

bool to_sample(const ddsi_serdata* data, void* bytes, void**, void*) {
  const CdrSample& sample = sample_of(data);
  static_cast<std::string*>(bytes)->assign(sample.bytes, 0, sample.size());
  return true;
}

ddsi_serdata* without_type(const ddsi_serdata* data) {
  auto sample = std::make_unique<CdrSample>(data->type, SDK_KEY);
  sample->type = nullptr;
  return sample.release();
}

bool key_to_sample(const ddsi_sertype*, const ddsi_serdata*, void* bytes, void**, void*) {
  static_cast<std::string*>(bytes)->clear();
  return true;
}

void free_sample(ddsi_serdata* data) { delete static_cast<CdrSample*>(data); }

std::size_t print_sample(const ddsi_sertype*, const ddsi_serdata*, char* text, std::size_t size) {
  if (size > 0) *text = '\0';
  return 0;
}

void key_of_none(const ddsi_serdata*, ddsi_keyhash* hash, bool) { *hash = {}; }

const ddsi_serdata_ops& sample_operations() {
  static const ddsi_serdata_ops operations = [] {
    ddsi_serdata_ops made{};
    made.eqkey = same_key;
    made.get_size = size_of;
    made.from_ser = from_fragments;
    made.from_ser_iov = from_pieces;
    made.from_keyhash = from_keyhash;
    made.from_sample = from_sample;
    made.to_ser = copy_bytes;
    made.to_ser_ref = lend_bytes;
    made.to_ser_unref = give_back;
    made.to_sample = to_sample;
    made.to_untyped = without_type;
    made.untyped_to_sample = key_to_sample;
    made.free = free_sample;
    made.print = print_sample;
    made.get_keyhash = key_of_none;
    return made;
  }();
  return operations;
}

void free_type(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete type;
}

bool same_type(const ddsi_sertype*, const ddsi_sertype*) { return true; }

std::uint32_t hash_of_type(const ddsi_sertype*) { return 0; }

/// Every sample is made by its owner, and it is one at a time.
void clear_samples(const ddsi_sertype*, void* samples, std::size_t count) {
  for (std::string& bytes : std::span(static_cast<std::string*>(samples), count)) bytes.clear();
}

/// Cyclone DDS empties a sample before it tells in it that a writer has left.
void free_contents(const ddsi_sertype*, void** samples, std::size_t count, dds_free_op_t) {
  for (void* sample : std::span(samples, count)) static_cast<std::string*>(sample)->clear();
}

ddsi_sertype* same_for_all(const ddsi_sertype* type, dds_data_representation_id_t,
                           dds_type_consistency_enforcement_qospolicy_t) {
  return const_cast<ddsi_sertype*>(type);
}

const ddsi_sertype_ops& type_operations() {
  static const ddsi_sertype_ops operations = [] {
    ddsi_sertype_ops made{};
    made.version = ddsi_sertype_v0;
    made.free = free_type;
    made.zero_samples = clear_samples;
    made.free_samples = free_contents;
    made.equal = same_type;
    made.hash = hash_of_type;
    made.derive_sertype = same_for_all;
    return made;
  }();
  return operations;
}

}  // namespace

dds_entity_t create_cdr_topic(dds_entity_t participant, const std::string& topic, const std::string& type) {
  auto made = std::make_unique<ddsi_sertype>();
  ddsi_sertype_init(made.get(), type.c_str(), &type_operations(), &sample_operations(), true);
  made->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  ddsi_sertype* passed = made.release();
  const dds_entity_t entity =
      dds_create_topic_sertype(participant, topic.c_str(), &passed, nullptr, nullptr, nullptr);
  if (entity < 0) ddsi_sertype_unref(passed);  // it is taken over only by a topic
  return entity;
}

}  // namespace outrider
