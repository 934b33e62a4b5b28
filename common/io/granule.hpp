// What every stage knows about its granule, and where it knows it from: the scene, the file of the stage before, or the
// defaults.
#pragma once

#include "common/io/agglomerate_reader.hpp"
#include "common/io/agglomerate_writer.hpp"
#include "common/io/parameters.hpp"
#include "common/io/report.hpp"

namespace crumble {

// The file of the stage before.
struct Parent {
  std::string file;
  Properties properties;
  double radius = 0;  // mean, m
};

// The scene takes the parent's properties where it says nothing itself.
void inherit(Scene& scene, const Parent& parent);

// Of the scene, and of the parent what the scene does not know. A number given as a word is left out.
Properties properties_of(const Scene& scene, const Properties& parent = {});
void write_properties(AgglomerateWriter& writer, const Properties& properties);

// "scene", "file" or "default": where a value of the scene comes from.
std::string source_of(const Scene& scene, const std::string& key);

// The first line of a program: radius, material, liquid and scale factor, each with its source; where scene and file
// differ both values. Without a parent the granule is made here.
std::string granule_line(const Scene& scene, const std::optional<Parent>& parent);

// Where the modulus is of another material than the default surface energy: that this is so, and what it means. Empty
// otherwise.
std::string material_warning(const Scene& scene);

// The whole scene under `inputs`; under `granule` what granule_line() says, and the warning if there is one.
void report_inputs(Report& report, const Scene& scene, const std::optional<Parent>& parent);

}  // namespace crumble
