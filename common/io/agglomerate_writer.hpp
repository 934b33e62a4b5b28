// Writes an agglomerate file frame by frame. Everything goes to PATH.tmp; only finish() marks it complete and gives it
// its name, so that a half-written file never looks finished.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/agglomerate/agglomerate.hpp"
#include "common/io/hdf5.hpp"
#include "common/io/interrupt.hpp"
#include "common/io/provenance.hpp"

namespace crumble {

struct FileDescription {
  std::string stage;  // dryer, breaker, rigidstress or agglomerate: the program that writes
  Provenance provenance;
  std::string input, resolved;          // scene as given, and with every default; empty where there is no scene
  std::string force_meaning = "total";  // which force and torque a Frame holds
};

// What only the stage knows about a frame, by the name it has under /observables. In SI, whatever the unit in the file.
using Observables = std::vector<std::pair<std::string, double>>;

// A program's mistake (unknown name, wrong size, time that does not increase) is a std::logic_error, a number that is
// not finite a ContentError, a full disk a WriteError.
class AgglomerateWriter {
 public:
  AgglomerateWriter(std::filesystem::path path, const Particles& particles, const FileDescription& description);

  AgglomerateWriter(const AgglomerateWriter&) = delete;
  AgglomerateWriter& operator=(const AgglomerateWriter&) = delete;
  ~AgglomerateWriter();  // removes the temporary file unless finished

  // Steps and times must increase. Every frame has the same fields and the same observables as the first; those of the
  // table that follow from the frame (radius of gyration, fragments and so on) are computed here.
  void append(const Frame& frame, const Observables& observables = {});

  // One more sample of a dense series, /series/<name>; value in SI, `unit` as it stands in the file.
  void sample(const std::string& name, const std::string& unit, std::int64_t step, double time, double value);

  // Anything else in the table, once, in SI: std::int32_t, std::int64_t or double. `method` says how it was computed;
  // `unit` is only for rows whose unit is "any".
  template <class T>
  void put(const std::string& path, std::span<const T> values, const hdf5::Shape& shape, const std::string& method = "",
           const std::string& unit = "");
  void put(const std::string& path, double value, const std::string& method = "");
  void put_attribute(const std::string& path, const std::string& value);  // OBJECT@NAME

  // State: drying, dry, relaxed or broken. What gets the name has been read again and found valid, and is on the disk.
  void finish(const std::string& state);

 private:
  struct Series {
    hdf5::Dataset step, time, value;
    double factor = 1;
    std::optional<std::int64_t> last_step;
    double last_time = 0;
    std::vector<std::int64_t> steps;
    std::vector<double> times, values;
  };
  std::filesystem::path temporary() const { return path_.string() + ".tmp"; }
  void write_head(const Particles& particles, const FileDescription& description);
  void write_provenance(const Provenance& provenance);
  hdf5::Dataset& rows(const std::string& path);
  template <class T>
  void append_frame_rows(const std::string& path, std::span<const T> values);
  void append_vectors(const std::string& path, const std::vector<Vector3>& vectors);
  void append_contacts(const std::vector<Contact>& contacts);
  void append_observables(const Frame& frame, const Observables& observables);
  void write_pending(Series& series);
  void close();
  void require_complete() const;

  std::filesystem::path path_;
  hdf5::File file_;
  std::pair<std::uint64_t, std::uint64_t> identity_;  // of the temporary file
  std::map<std::string, hdf5::Dataset> rows_;         // that grow with the frames, by path without /value
  std::map<std::string, Series> series_;
  std::vector<double> radius_, mass_;  // SI
  std::vector<std::int32_t> last_pairs_;
  std::string stage_, force_meaning_;
  std::uint64_t frames_ = 0, contacts_ = 0;
  std::int64_t last_step_ = 0;
  double last_time_ = 0;
  bool open_ = true;
  RemovedAtSuddenEnd removed_;
};

}  // namespace crumble
