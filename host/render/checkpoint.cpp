#include "host/render/checkpoint.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "host/error.h"
#include "host/image/atomic_file.h"

namespace meniscal {
namespace {

constexpr std::uint64_t kMagic = 0x32305450'4353494d;  // "MISCPT02": the last two are the format's version
constexpr std::uint64_t kMostUnknown = 1 << 20;        // numbers in a list whose length nothing else tells

// FNV-1a: finds damage, not malice.
class Checksum {
 public:
  void add(const char* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) value_ = (value_ ^ static_cast<unsigned char>(bytes[i])) * 0x100000001b3u;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

// Both archives take the same sequence of values: one function below says what a checkpoint holds.
class Writer {
 public:
  explicit Writer(std::ofstream& stream) : stream_(stream) {}
  template <class T>
  void operator()(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    std::uint64_t count = list.size();
    (*this)(count);
    bytes(reinterpret_cast<const char*>(list.data()), count * sizeof(T));
  }
  void end() {
    std::uint64_t sum = sum_.value();
    (*this)(sum);
  }

 private:
  void bytes(const char* from, std::size_t count) {
    sum_.add(from, count);
    stream_.write(from, static_cast<std::streamsize>(count));
  }
  std::ofstream& stream_;
  Checksum sum_;
};

class Reader {
 public:
  explicit Reader(std::ifstream& stream) : stream_(stream) {}
  template <class T>
  void operator()(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes(reinterpret_cast<char*>(&value), sizeof value);
  }
  // Lists that the film has already keep their length.
  template <class T>
  void operator()(std::vector<T>& list) {
    std::uint64_t count = 0;
    (*this)(count);
    if (list.empty() ? count > kMostUnknown : count != list.size()) throw std::runtime_error("it is damaged");
    list.resize(count);
    bytes(reinterpret_cast<char*>(list.data()), count * sizeof(T));
  }
  void end() {
    const std::uint64_t sum = sum_.value();
    std::uint64_t written = 0;
    (*this)(written);
    if (written != sum || stream_.peek() != std::ifstream::traits_type::eof())
      throw std::runtime_error("it is damaged");
  }

 private:
  void bytes(char* to, std::size_t count) {
    if (!stream_.read(to, static_cast<std::streamsize>(count))) throw std::runtime_error("it is cut off");
    sum_.add(to, count);
  }
  std::ifstream& stream_;
  Checksum sum_;
};

template <class Archive>
void exchange(Archive& archive, Checkpoint& checkpoint, Film& film) {
  archive(checkpoint.passes);
  archive(checkpoint.seconds);
  for (Tally& t : checkpoint.tallies) {
    for (std::uint64_t* number : {&t.started, &t.kept, &t.visible, &t.stored}) archive(*number);
    for (double* flux : {&t.flux_in, &t.flux_escaped, &t.flux_cut, &t.flux_absorbed, &t.flux_dropped}) archive(*flux);
    archive(t.flux_landed);
  }
  film.exchange(archive);
}

// One line a name and value, as bytes.
std::vector<char> as_bytes(const Identity& identity) {
  std::string text;
  for (const auto& [name, value] : identity) text += name + "=" + value + "\n";
  return {text.begin(), text.end()};
}

Identity from_bytes(const std::vector<char>& bytes) {
  Identity identity;
  std::string name, part;
  for (const char c : bytes)
    if (c == '=' && name.empty())
      name = std::exchange(part, {});
    else if (c == '\n')
      identity[std::exchange(name, {})] = std::exchange(part, {});
    else
      part += c;
  return identity;
}

}  // namespace

void save_checkpoint(const std::string& path, const Identity& identity, const Checkpoint& checkpoint, Film& film) {
  write_file(path, [&](std::ofstream& stream) {
    Writer writer(stream);
    std::uint64_t magic = kMagic;
    std::vector<char> bytes = as_bytes(identity);
    Checkpoint copy = checkpoint;
    writer(magic);
    writer(bytes);
    exchange(writer, copy, film);
    writer.end();
  });
}

std::optional<Checkpoint> load_checkpoint(const std::string& path, const Identity& identity, Film& film) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    std::ifstream stream(path, std::ios::binary);
    Reader reader(stream);
    std::uint64_t magic = 0;
    std::vector<char> bytes;
    reader(magic);
    if (magic != kMagic) throw std::runtime_error("it is no checkpoint of this version");
    reader(bytes);
    const Identity written = from_bytes(bytes);
    if (written != identity) throw std::runtime_error("it is of another rendering: " + differences(written, identity));
    Checkpoint checkpoint;
    exchange(reader, checkpoint, film);
    reader.end();
    return checkpoint;
  } catch (const std::exception& error) {
    throw Error(ExitCode::scene, fmt::format("{}: {}; leave --resume out to start anew", path, error.what()));
  }
}

}  // namespace meniscal
