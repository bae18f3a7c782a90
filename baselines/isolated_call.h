#pragma once

#include <functional>
#include <string>

namespace ccdt {

/// What came of a call that might have ended its process.
struct IsolatedCall {
  bool returned = false;  ///< else it was ended by `signal`, or called exit
  int signal = 0;
  std::string value;    ///< what the work returned
  std::string printed;  ///< the first lines of what it printed, standard output and standard error together
};

/// Does some work in a fork of this process and waits for it. For libraries that crash, exit or print instead of
/// returning an error: what happens there does not happen here, but for the bytes that the work returns. The work must
/// not throw.
IsolatedCall call_isolated(const std::function<std::string()>& work);

}  // namespace ccdt
