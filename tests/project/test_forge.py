"""What forges, archives and Docker read of the project says what the project says, and runs what CI runs; the version is one."""
import json
import re

import pytest

from nlmech_tree import SOURCE, chapters, program, run, text_of

CITATION = text_of("CITATION.cff")
CMAKE = text_of("CMakeLists.txt")
VERSION = re.search(r"project\(nlmech\s+VERSION (\S+)", CMAKE)[1]


def cited(name):
    """The value of a field of the citation."""
    return re.search(rf'^{name}: "?(.*?)"?$', CITATION, re.MULTILINE)[1]


def test_codemeta_says_what_citation_and_build_say():
    meta = json.loads(text_of("codemeta.json"))
    authors, references = CITATION.split("references:", 1)
    assert meta["version"] == cited("version") == VERSION
    assert meta["license"] == f"https://spdx.org/licenses/{cited('license')}"
    assert meta["description"] == re.search(r'DESCRIPTION "([^"]+)"', CMAKE)[1]
    assert cited("title") == "nlmech: n" + meta["description"][1:]
    assert [author["name"] for author in meta["author"]] == re.findall(r'^  - name: "([^"]+)"', authors, re.MULTILINE)
    assert meta["keywords"] == re.findall(r"^  - (.+)$", authors.split("keywords:", 1)[1], re.MULTILINE)


def test_licence_is_the_one_of_the_citation():
    licence = text_of("LICENSE")
    assert cited("license") == "MIT" and licence.startswith("MIT License\n")
    assert "the nlmech authors" in licence


def test_version_is_the_newest_of_the_changelog():
    assert re.search("^## (.*)$", text_of("CHANGELOG.md"), re.MULTILINE)[1].startswith(VERSION)


def test_version_is_what_readme_tells_to_look_for():
    assert f"\nfind_package(nlmech {VERSION.rpartition('.')[0]} " in text_of("README.md")


@pytest.mark.parametrize("chapter", chapters())
def test_version_is_printed_by_programs(chapter):
    assert run(program(chapter), "--version").stdout == f"nlmech {VERSION}\n"


@pytest.mark.parametrize("file, least", [("Dockerfile", 1), (".github/workflows/test.yml", 3)])
def test_targets_are_there_and_run_by_ci(file, least):
    targets = re.findall(r"(?:RUN|run:) make ([a-z]+)\n", text_of(file))
    assert len(targets) >= least
    assert [target for target in targets if f"\n{target}: " not in text_of("Makefile")] == []
    assert [target for target in targets if f"make {target}" not in text_of(".ci/run")] == []


def test_dockerfile_runs_what_the_trial_in_a_bare_root_runs():
    assert "RUN /tmp/package install /tmp/nlmech.deb" in text_of("Dockerfile")
    assert 'inside "$root" /tmp/package install /tmp/nlmech.deb' in text_of("scripts/package")
    assert "scripts/package try" in text_of(".ci/run")
    copied = re.findall(r"COPY (scripts/\S+)", text_of("Dockerfile"))
    assert [file for file in copied if not (SOURCE / file).exists()] == []


def test_workflow_tests_and_publishes_by_commands_of_the_project():
    workflow = text_of(".github/workflows/test.yml")
    assert "run: make test\n" in workflow
    assert "path: build/book/html\n" in workflow


def test_tracked_folders_survive_docker_and_clean():
    """An image is built of what .dockerignore lets through, and `make clean` leaves what git tracks."""
    files = run("git", "ls-files", "figures", "tables", cwd=SOURCE, code=None).stdout.split()
    folders = {"/".join(file.split("/")[:2]) for file in files if file.count("/") > 1}
    clean = text_of("Makefile").partition("\nclean:")[2]
    assert [folder for folder in folders if f"!{folder}" not in text_of(".dockerignore").splitlines()] == []
    assert [folder for folder in folders if f" ! -name {folder.partition('/')[2]} " not in clean] == []
