// What a device was made to do, noted where it is made, allocated and dispatched: for the statistics.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace meniscal::gpu {

struct PassRecord {
  std::string name;
  std::map<std::string, double> variant;            // the shader's specialisation constants, as it was compiled
  std::map<std::string, std::uint64_t> dispatches;  // by stage; none: compiled alone
};

struct Record {
  std::vector<PassRecord> passes;  // one a variant, in order of their compilation
  std::map<std::string, std::size_t>
      buffers;  // bytes asked for by all of a name at a time, at the most; 0 are left out

  // Where the pass stands.
  std::size_t add_pass(const std::string& name, const std::map<std::string, double>& variant);
  void change_buffer(const std::string& name, std::ptrdiff_t bytes);  // negative: it is gone

 private:
  std::map<std::string, std::size_t> bytes_now_;
};

}  // namespace meniscal::gpu
