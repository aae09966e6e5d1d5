// The verb live: a page for this machine alone. What lacks the token, names another host or comes from
// another site is refused; nonsense is refused with its reason; whatever clients do or leave undone, the page
// is there and Ctrl-C leaves a data set that replays.
#include <string>

#include <gtest/gtest.h>

#include "program.hpp"

namespace mckibben::cli {
namespace {

/// A program in the background, asked by Python's own client; `asks` is what is asked of it there. `ask(path,
/// body, headers)` gives status and text.
Said with_page(const Scratch& scratch, const std::string& asks, const std::string& options = "") {
  write_text(scratch / "ask.py",
             "import http.client, json, os, re, signal, socket, subprocess, sys, threading, time\n"
             "M = os.environ['M']\n"
             "live = subprocess.Popen([M, 'live', 'thesis'] + " +
                 std::string(options.empty() ? "[]" : options) +
                 ", stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)\n"
                 "address = live.stdout.readline().strip()\n"
                 "port, token = re.fullmatch(r'http://127.0.0.1:(\\d+)/([0-9a-f]{32})/', address).groups()\n"
                 "def ask(path, body=None, **headers):\n"
                 "    line = http.client.HTTPConnection('127.0.0.1', int(port))\n"
                 "    headers = {k.replace('_', '-'): v for k, v in headers.items()}\n"
                 "    if body is not None: headers.setdefault('Content-Type', 'application/json')\n"
                 "    line.request('GET' if body is None else 'POST', path, body, headers)\n"
                 "    answer = line.getresponse()\n"
                 "    return answer.status, answer.read().decode(), dict(answer.getheaders())\n"
                 "def do(**command):\n"
                 "    return json.loads(ask(f'/{token}/do', json.dumps(command))[1])['refused']\n"
                 "def expect(what, wanted):\n"
                 "    assert what == wanted, (what, wanted)\n" +
                 asks +
                 "live.send_signal(signal.SIGINT)\n"
                 "out, err = live.communicate(timeout=120)\n"
                 "print(err)\n"
                 "sys.exit(live.returncode)\n");
  return shell("M=\"$M\" python3 ask.py", scratch);
}

TEST(Live, RefusesWhoeverLacksTheTokenOrComesFromElsewhere) {
  const Scratch scratch;
  const Said said = with_page(
      scratch,
      "page = f'/{token}/'\n"
      "status, text, headers = ask(page)\n"
      "expect(status, 200)\n"
      "policy = headers['Content-Security-Policy']\n"
      "assert \"default-src 'none'\" in policy and 'unsafe' not in policy and 'http' not in policy, policy\n"
      "assert 'Access-Control-Allow-Origin' not in headers\n"
      "for path in ['/', '/page.js', '/do', '/news', f'/{token[:-1]}/', '/' + '0' * 32 + '/',\n"
      "             f'/x{token}/', f'//{token}/', f'/{token.upper()}/' if token.upper() != token else '/']:\n"
      "    expect(ask(path)[0], 403)\n"
      "expect(ask('/do', '{\"do\": \"again\"}')[0], 403)\n"
      "expect(ask(page, Host='evil.example')[0], 403)\n"
      "expect(ask(page, Host=f'evil.example:{port}')[0], 403)\n"
      "expect(ask(page, Host=f'localhost:{port}')[0], 200)\n"
      "expect(ask(page + 'do', '{\"do\": \"again\"}', Origin='http://evil.example')[0], 403)\n"
      "expect(ask(page + 'do', '{\"do\": \"again\"}', Origin='null')[0], 403)\n"
      "expect(ask(page + 'do', '{\"do\": \"again\"}', Sec_Fetch_Site='cross-site')[0], 403)\n"
      "expect(ask(page + 'do', '{\"do\": \"again\"}', Content_Type='text/plain')[0], 400)\n"
      "expect(ask(page + 'do', '{\"do\": \"again\"}', Origin=f'http://127.0.0.1:{port}')[0], 200)\n"
      "expect(ask(page + 'do', 'x' * 5000)[0], 413)\n"
      "expect(ask(page + '../../etc/passwd')[0], 404)\n"
      "for other in ['127.0.0.2', socket.gethostbyname(socket.gethostname())]:\n"
      "    if other == '127.0.0.1': continue\n"
      "    try:\n"
      "        socket.create_connection((other, int(port)), 2)\n"
      "        raise SystemExit(f'{other} answers')\n"
      "    except OSError: pass\n"
      "live_2 = subprocess.run([M, 'live', 'thesis', '--port', port], capture_output=True, text=True)\n"
      "expect(live_2.returncode, 70)\n"
      "assert f'port {port} of 127.0.0.1' in live_2.stderr, live_2.stderr\n");
  EXPECT_EQ(said.status, 0) << said.out << said.err;
}

TEST(Live, NonsenseIsRefusedAndARecordingOutlivesCtrlC) {
  const Scratch scratch;
  const Said said = with_page(scratch,
                              "expect(do(do='command', to=99), 'current = 99 mA: must be from 0 to 20 mA')\n"
                              "expect(do(do='load', kg='much'), 'kg = \"much\": must be a number')\n"
                              "expect(ask(f'/{token}/do', 'no json')[0], 400)\n"
                              "expect(do(do='record', from_rest=True), '')\n"
                              "expect(do(do='sweep', shape='sine', low=4, high=12, period=2), '')\n"
                              "line = http.client.HTTPConnection('127.0.0.1', int(port))\n"
                              "line.request('GET', f'/{token}/news')\n"
                              "news, last = line.getresponse(), 0\n"
                              "while last < 2.0:\n"
                              "    heard = news.readline().decode()\n"
                              "    if heard.startswith('data: '): last = max([s[0] for s in "
                              "json.loads(heard[6:]).get('samples', [])] + [last])\n");
  EXPECT_EQ(said.status, 0) << said.out << said.err;
  EXPECT_TRUE(holds(said.out, "Recorded ", "the program ended"));
  EXPECT_EQ(mckibben("check out/thesis-live/dataset.yaml", scratch).status, 0);
  const Said replayed = mckibben("replay out/thesis-live", scratch);
  EXPECT_EQ(replayed.status, 0) << replayed.err;
}

/// Sends this text by the port.
constexpr const char* clients =
    "def client(text, size=None):\n"
    "    line = socket.socket()\n"
    "    if size: line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, size)\n"
    "    line.connect(('127.0.0.1', int(port)))\n"
    "    line.sendall(text.replace('\\n', '\\r\\n').encode())\n"
    "    return line\n"
    "host = f'Host: 127.0.0.1:{port}\\n'\n"
    "command = f'POST /{token}/do HTTP/1.1\\n{host}Content-Type: application/json\\n'\n";

TEST(Live, StuckSlowAndIdleClientsKeepNobodyFromThePageAndCtrlCKeepsTheRecording) {
  const Scratch scratch;
  const Said said = with_page(
      scratch, std::string(clients) +
                   "expect(do(do='record', from_rest=True), '')\n"
                   "stuck = [client(f'GET /{token}/news HTTP/1.1\\n{host}\\n', 4096) for _ in range(2)]\n"
                   "stuck += [client('') for _ in range(20)]\n"
                   "stuck += [client(command + 'Content-Length: 20\\n\\n{') for _ in range(20)]\n"
                   "slow = [client('GET / HTTP/1.1\\nX: ') for _ in range(20)]\n"
                   "slow += [client(command + 'Transfer-Encoding: chunked\\n\\n5;x=') for _ in range(2)]\n"
                   "def dribble():\n"
                   "    while True:\n"
                   "        for each in slow:\n"
                   "            try: each.sendall(b'a')\n"
                   "            except OSError: pass\n"
                   "        time.sleep(0.1)\n"
                   "threading.Thread(target=dribble, daemon=True).start()\n"
                   "time.sleep(2.0)\n"
                   "expect(ask(f'/{token}/')[0], 200)\n"
                   "expect(do(do='command', to=9.0), '')\n");
  EXPECT_EQ(said.status, 0) << said.out << said.err;
  EXPECT_TRUE(holds(said.out, "Recorded ", "the program ended")) << said.out;
  EXPECT_EQ(mckibben("check out/thesis-live", scratch).status, 0);
}

TEST(Live, NoMoreOfARequestIsTakenThanACommandNeedsWhateverItsEncoding) {
  const Scratch scratch;
  const Said said = with_page(
      scratch, std::string(clients) +
                   "def first_line(text):\n"
                   "    line, answer = client(''), b''\n"
                   "    try: line.sendall(text.replace('\\n', '\\r\\n').encode())\n"
                   "    except OSError: pass  # it has heard enough\n"
                   "    try:\n"
                   "        while True:\n"
                   "            more = line.recv(4096)\n"
                   "            if not more: break\n"
                   "            answer += more\n"
                   "    except OSError: pass\n"
                   "    return answer.decode().split('\\r\\n')[0].split()[1:2]\n"
                   "chunk = '400\\n' + 1024 * ' ' + '\\n'\n"
                   "expect(first_line('GET / HTTP/1.1\\nX: ' + 20000 * 'a'), ['431'])\n"
                   "expect(first_line('GET / HTTP/1.1\\n' + 2000 * 'X: abcdefg\\n'), ['431'])\n"
                   "expect(first_line(command + 'Transfer-Encoding: chunked\\n\\n' + 8 * chunk), ['413'])\n"
                   "expect(first_line(command + 'Content-Length: 99999999999\\n\\n'), ['413'])\n"
                   "expect(first_line(command + 'Content-Length: 2\\nContent-Length: 3\\n\\n{}'), ['400'])\n"
                   "expect(first_line('no request\\n\\n'), ['400'])\n"
                   "chunk = '{\"do\": \"again\"}'\n"
                   "expect(first_line(command + 'Connection: close\\nTransfer-Encoding: chunked\\n\\n' +\n"
                   "                  f'{len(chunk):x}\\n{chunk}\\n0\\n\\n'), ['200'])\n");
  EXPECT_EQ(said.status, 0) << said.out << said.err;
}

TEST(Live, RefusesRigsThatItCannotShow) {
  const Scratch scratch;
  write_text(scratch / "bad.yaml", "schema: mckibben-rig/1\nmuscle:\n  rest_length: 3 kg\n");
  const Said bad = mckibben("live bad.yaml", scratch);
  EXPECT_EQ(bad.status, 65);
  EXPECT_TRUE(holds(bad.err, "bad.yaml:3:"));
  write_text(scratch / "held.yaml", "schema: mckibben-rig/1\nmechanics: {kind: held_length}\n");
  const Said held = mckibben("live held.yaml", scratch);
  EXPECT_EQ(held.status, 65);
  EXPECT_TRUE(holds(held.err, "live cannot take it yet: the rig's muscle is held"));
  EXPECT_EQ(mckibben("live thesis_pair --load '5 kg'", scratch).status, 65);
  EXPECT_EQ(mckibben("live nowhere.yaml", scratch).status, 66);
  EXPECT_EQ(mckibben("live thesis --load much", scratch).status, 64);
  EXPECT_EQ(mckibben("live thesis --port 70000", scratch).status, 64);
  write_text(scratch / "soft.yaml", "schema: mckibben-rig/1\nmuscle: {stop_stiffness: 10 kN/m}\n");
  const Said heavy = mckibben("live soft.yaml --load '400 kg'", scratch);
  EXPECT_EQ(heavy.status, 65);
  EXPECT_TRUE(holds(heavy.err, "the taut threads of this muscle bear"));
}

}  // namespace
}  // namespace mckibben::cli
