import unittest

from sandbox import Sandbox

APT = '#!/bin/bash\necho "apt-get $DEBIAN_FRONTEND $*" >> "$LOG"\nexit "${APT_CODE:-0}"\n'


class Packages(Sandbox):
    def setUp(self):
        super().setUp()
        self.stand_in("apt-get", APT)
        self.stand_in("apt-cache", "#!/bin/bash\n")  # no lists yet
        # ninja-build is not there at all, libfmt-dev was removed but left its configuration.
        self.stand_in("dpkg-query", """#!/bin/bash
shift 3
for package in "$@"; do
  case $package in
    ninja-build) echo "no packages found matching ninja-build" >&2; code=1 ;;
    libfmt-dev) echo "libfmt-dev=config-files" ;;
    *) echo "$package=installed" ;;
  esac
done
exit ${code:-0}
""")

    def packages(self, user, sudo_code, **environment):
        self.stand_in("id", f"#!/bin/bash\necho {user}\n")
        self.stand_in("sudo", f'#!/bin/bash\n[[ {sudo_code} == 0 ]] || exit 1\nshift\n"$@"\n')
        return self.run_in_sandbox("pipeline/packages.sh", **environment)

    def assert_installed(self, done):
        self.assertEqual(done.returncode, 0, done.stderr)
        update, install = self.called("apt-get")
        self.assertRegex(update, r"^apt-get noninteractive .* update$")
        self.assertRegex(install, r"^apt-get noninteractive .* install --no-install-recommends -y ninja-build libfmt-dev$")

    def test_root_installs_what_is_missing_and_no_more(self):
        self.assert_installed(self.packages(user=0, sudo_code=1))

    def test_sudo_without_password_installs_too(self):
        self.assert_installed(self.packages(user=1000, sudo_code=0))

    def test_without_the_right_the_exact_command_is_printed(self):
        done = self.packages(user=1000, sudo_code=1)
        self.assertEqual(done.returncode, 1)
        self.assertIn("\n  sudo apt-get update && sudo apt-get install --no-install-recommends -y ninja-build libfmt-dev\n",
                      done.stderr)
        self.assertEqual(self.called("apt-get"), [])

    def test_what_the_release_does_not_have_is_named_and_left_out(self):
        self.stand_in("apt-cache", '#!/bin/bash\necho "Package: g++"\necho "Package: libfmt-dev"\nexit 100\n')
        done = self.packages(user=0, sudo_code=1)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("This release has no ninja-build\n", done.stderr)
        self.assertRegex(self.called("apt-get")[-1], r" install --no-install-recommends -y libfmt-dev$")

    def test_where_only_that_is_missing_nothing_is_installed(self):
        self.stand_in("apt-cache", '#!/bin/bash\necho "Package: g++"\n')
        done = self.packages(user=1000, sudo_code=1)
        self.assertEqual((done.returncode, self.called("apt-get")), (0, []), done.stderr)

    def test_a_failed_installation_stops_before_the_build(self):
        self.stand_in("id", "#!/bin/bash\necho 0\n")
        done = self.make(APT_CODE="100")
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(self.called("cmake"), [])

    def test_with_everything_there_nothing_is_said(self):
        self.stand_in("dpkg-query", '#!/bin/bash\nshift 3\nprintf "%s=installed\\n" "$@"\n')
        done = self.packages(user=1000, sudo_code=1)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_packages_of_a_section_are_for_who_asks_for_it(self):
        self.stand_in("dpkg-query", '#!/bin/bash\nshift 3\necho "$*" >> "$LOG"\nprintf "%s=installed\\n" "$@"\n')
        asked = {}
        for section in ((), ("portability",), ("package",)):
            self.forget()
            done = self.run_in_sandbox("pipeline/packages.sh", *section)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            asked[section] = set(self.log.read_text().split())
        self.assertEqual(asked["portability",] - asked[()], {"clang", "libomp-dev"})
        self.assertEqual(asked["package",] - asked[()], {"debootstrap", "dpkg-dev", "file", "lintian"})
        self.assertLessEqual({"g++", "libeigen3-dev", "povray"}, asked[()])
        self.assertFalse([name for name in asked["portability",] if "[" in name or "#" in name])


if __name__ == "__main__":
    unittest.main()
