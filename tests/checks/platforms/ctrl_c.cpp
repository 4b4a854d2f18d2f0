// Ctrl-C under Windows, pressed while the tool waits for more: what it has answered stands, and it ends as Ctrl-C ends
// what does not know of it.
//   ctrl_c VIEWPROJ CAMERA ANSWER      ANSWER: to the point 1 1 1
#include <windows.h>

#include <cstdio>
#include <string>

namespace {

constexpr DWORD kPatience = 60000, kEndedByCtrlC = 0xC000013A;

int fail(const std::string& what) {
  std::fprintf(stderr, "ctrl_c: %s (%lu)\n", what.c_str(), ::GetLastError());
  return 1;
}

struct Pipe {
  HANDLE read = nullptr, write = nullptr;
  Pipe() {
    SECURITY_ATTRIBUTES inherited = {sizeof inherited, nullptr, TRUE};
    ::CreatePipe(&read, &write, &inherited, 0);
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return fail("three arguments are needed");
  ::FreeConsole();
  if (!::AllocConsole()) return fail("there is no console");
  Pipe in, out;
  ::SetHandleInformation(in.write, HANDLE_FLAG_INHERIT, 0);
  ::SetHandleInformation(out.read, HANDLE_FLAG_INHERIT, 0);
  STARTUPINFOA startup = {};
  startup.cb = sizeof startup;
  startup.dwFlags = STARTF_USESTDHANDLES;
  startup.hStdInput = in.read;
  startup.hStdOutput = out.write;
  startup.hStdError = ::GetStdHandle(STD_ERROR_HANDLE);
  std::string command = std::string("\"") + argv[1] + "\" project -c \"" + argv[2] + "\"";
  PROCESS_INFORMATION process = {};
  if (!::CreateProcessA(nullptr, command.data(), nullptr, nullptr, TRUE, 0, nullptr, nullptr, &startup, &process))
    return fail(command + " does not start");
  ::CloseHandle(in.read);
  ::CloseHandle(out.write);
  const std::string point = "1 1 1\n", wanted = std::string(argv[3]) + "\n";
  DWORD bytes = 0;
  ::WriteFile(in.write, point.data(), static_cast<DWORD>(point.size()), &bytes, nullptr);
  char answer[256];
  if (!::ReadFile(out.read, answer, sizeof answer, &bytes, nullptr)) return fail("no answer");
  if (std::string(answer, bytes) != wanted) return fail("the answer is " + std::string(answer, bytes));
  ::SetConsoleCtrlHandler(nullptr, TRUE);  // is not for this process
  if (!::GenerateConsoleCtrlEvent(CTRL_C_EVENT, 0)) return fail("there is no Ctrl-C");
  if (::WaitForSingleObject(process.hProcess, kPatience) != WAIT_OBJECT_0) return fail("Ctrl-C does not end it");
  DWORD code = 0;
  ::GetExitCodeProcess(process.hProcess, &code);
  return code == kEndedByCtrlC ? 0 : fail("it ends with " + std::to_string(code));
}
