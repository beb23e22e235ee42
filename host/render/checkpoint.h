// A rendering so far, in a file: to go on from as if it had never ended.
#pragma once

#include "host/render/backend.h"
#include "host/render/film.h"
#include "host/render/header.h"

namespace meniscal {

struct Checkpoint {
  PassRange passes;    // that are on the film
  Tallies tallies;     // theirs
  double seconds = 0;  // that they took
};

// Writes sums in double precision, bit for bit; the file appears whole or not at all (see write_file).
void save_checkpoint(const std::string& path, const Identity& identity, const Checkpoint& checkpoint, Film& film);

// Puts the sums back onto an empty film of the same layers; nothing where there is no file. Throws
// Error(ExitCode::scene) where it is damaged, or of another scene or other settings.
std::optional<Checkpoint> load_checkpoint(const std::string& path, const Identity& identity, Film& film);

}  // namespace meniscal
