"""Finding and running the program."""
import contextlib
import io
import pathlib
import signal
import subprocess
import sys
import time
import unittest

from support import environment, fake_program, root, work

import umbrameter as um
from umbrameter.program import run


class FindProgram(unittest.TestCase):
    def test_the_variable_comes_before_the_path(self):
        first, second = fake_program("first", ""), fake_program("second", "")
        with environment(UMBRAMETER=first, PATH=second.parent):
            self.assertEqual(um.find_program(), first)
        with environment(UMBRAMETER=None, PATH=second.parent):
            self.assertEqual(um.find_program(), second)

    def test_a_missing_program_is_an_error_that_says_where_it_was_sought(self):
        with environment(UMBRAMETER=work / "nowhere"), self.assertRaisesRegex(um.Error, "nowhere.*set UMBRAMETER") as raised:
            um.find_program()
        self.assertIsNone(raised.exception.exit_code)

    def test_a_program_of_another_version_is_refused(self):
        with environment(UMBRAMETER=fake_program("old", "", "99.1.0")), self.assertRaisesRegex(um.Error, "is version 99.1.0"):
            um.find_program()

    def test_another_program_of_this_name_is_refused(self):
        with environment(UMBRAMETER="/bin/false"), self.assertRaisesRegex(um.Error, "is version unknown"):
            um.find_program()


class Run(unittest.TestCase):
    def test_an_error_has_the_line_and_the_exit_code_of_the_program(self):
        with self.assertRaisesRegex(um.Error, "^umbrameter: .*no-such-scene") as raised:
            run(["compare", "no-such-scene", "-o", str(work / "none")], progress=False)
        self.assertEqual(raised.exception.exit_code, 4)
        self.assertEqual(raised.exception.command[1], "compare")

    def test_a_program_that_dies_is_an_error(self):
        with environment(UMBRAMETER=fake_program("dying", "kill -SEGV $$")), self.assertRaises(um.Error) as raised:
            run([], progress=False)
        self.assertEqual(raised.exception.exit_code, -signal.SIGSEGV)

    def test_progress_and_notes_are_shown_and_an_error_only_raised(self):
        body = (r"""test -t 2 || exit 9
                printf '\r\033[Ktracing ##.. 50 %%' >&2; sleep 0.2; printf '\r\033[K' >&2
                echo 'note: größer' >&2; echo answer; echo 'umbrameter: broken' >&2; exit 5""")
        shown = io.StringIO()
        with environment(UMBRAMETER=fake_program("telling", body)), contextlib.redirect_stderr(shown):
            with self.assertRaisesRegex(um.Error, "^umbrameter: broken$"):
                run([], progress=True)
        self.assertIn("tracing ##.. 50 %", shown.getvalue())
        self.assertIn("note: größer", shown.getvalue())
        self.assertNotIn("broken", shown.getvalue())
        self.assertNotIn("\x1b", shown.getvalue())

    def test_long_output_on_both_streams_does_not_block(self):
        body = "i=0; while [ $i -lt 4000 ]; do echo 0123456789012345678901234567890123456789; " \
               "echo note: 0123456789012345678901234567890123456789 >&2; i=$((i+1)); done"
        with environment(UMBRAMETER=fake_program("long", body)):
            self.assertEqual(len(run([], progress=False)), 4000 * 41)

    def test_control_c_stops_the_program_once_and_waits_for_it(self):
        body = (f"cd {work}\ntrap 'echo stopped >>stopped; sleep 0.3; echo stored >>stopped; exit 130' INT\n"
                "echo >started\nwhile :; do sleep 0.05; done")
        program = fake_program("slow", body)
        script = ("import umbrameter\ntry:\n umbrameter.compare('courtyard')\n"
                  "except KeyboardInterrupt:\n print('interrupted')")
        with environment(UMBRAMETER=program, PYTHONPATH=root / "python"):
            process = subprocess.Popen([sys.executable, "-B", "-c", script], stdout=subprocess.PIPE, text=True)
        while not pathlib.Path(work / "started").exists():
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.communicate(timeout=60)[0], "interrupted\n")
        self.assertEqual((work / "stopped").read_text(), "stopped\nstored\n")


if __name__ == "__main__":
    unittest.main()
