// The frames and samples of a run that lasts, beside its output: OUTPUT.frames. It is only ever appended to, so
// whatever ends the run leaves all up to the last checkpoint as it was; at the end the output is written from it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/io/agglomerate_writer.hpp"
#include "common/io/sha256.hpp"
#include "common/numerics/saved_fields.hpp"

namespace crumble {

class FrameLog {
 public:
  // How far it was written, and what was.
  struct Mark {
    std::int64_t bytes = 0, records = 0;
    std::string sha256;
    void fields(SavedFields f);
  };
  struct Sample {
    const char *name, *unit;
    double value;
  };

  // Begins anew. Throws OpenError.
  explicit FrameLog(const std::filesystem::path& output);
  // Goes on from a mark; what was written behind it is cut off. Throws ContentError if what stands before it is not
  // what was written.
  FrameLog(const std::filesystem::path& output, const Mark& mark);
  ~FrameLog();
  FrameLog(const FrameLog&) = delete;
  FrameLog& operator=(const FrameLog&) = delete;

  // As of AgglomerateWriter. A number that is not finite is a ContentError, a full disk a WriteError.
  void append(const Frame& frame, const Observables& observables = {});
  void sample(std::int64_t step, double time, const std::vector<Sample>& samples);

  Mark mark() const;
  void flush() const;            // what was appended is on the disk
  void keep() { kept_ = true; }  // a checkpoint needs it
  void write_to(AgglomerateWriter& writer) const;
  void remove();
  // For a run that begins anew. What was written stays until it is cut off: the checkpoint before may still need it.
  void begin_anew();
  void cut();

 private:
  void put(const SavedState& record);
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t bytes_ = 0, records_ = 0;
  Sha256 digest_;
  bool kept_ = false;
};

}  // namespace crumble
