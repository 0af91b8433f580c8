# Two commands do all: `make figures` and `make test`. Each installs what is missing, builds, and runs only what changed.
#
#   make PRESET=dev ...                     another preset of CMakePresets.json, in build-dev/
#   make NLMECH_CHAPTERS=geodesy ...        a choice of chapters; NLMECH_PEERS=none for no peers

PRESET ?= release
BUILD := $(if $(filter release,$(PRESET)),build,build-$(PRESET))
OUT := .
# Sections of packages.txt, by goal.
needs = $(if $(filter $(2),$(MAKECMDGOALS)),$(1))
SECTIONS := programs $(call needs,tests,test test-long randomised book-test oracles) $(call needs,pages,check pages bench book book-test package) \
  $(call needs,benchmarks,bench) $(call needs,book,book book-test package) $(call needs,browser,book-test test-long) $(call needs,package,package) \
  $(call needs,python,python)
# Tests are configured once a goal runs them, and stay so.
NLMECH_TESTS := $(or $(call needs,ON,test test-long randomised book-test),$(if $(wildcard $(BUILD)/CMakeCache.txt),,OFF))
SELECTION := $(foreach v,NLMECH_CHAPTERS NLMECH_PEERS NLMECH_TESTS NLMECH_WARNINGS_ARE_ERRORS NLMECH_UNITY,$(if $($(v)),-D$(v)='$($(v))'))
CHAPTERS = $(shell cat $(BUILD)/chapters.txt 2>/dev/null)
DRAWN = $(CHAPTERS:%=$(OUT)/figures/%/.complete)
# All chapters at once: what measures times waits until it has the machine for itself.
AT_ONCE = $(MAKE) --no-print-directory -j

.PHONY: help deps configure build programs figures tables test test-long randomised oracles check bench book book-test package gallery pages python clean
help:
	@echo "make figures         all figures and tables of all chapters"
	@echo "make test            all tests but the long ones"
	@echo "make test-long       the long tests, except random cases (make randomised) and oracles (make oracles)"
	@echo "make tables          numbers and tables without drawing"
	@echo "make chapter-NAME    one chapter: figures, tables, verdicts"
	@echo "make check           compare published and computed values, figures, claims; tables/REPRODUCTION.md"
	@echo "make book            all chapters as a book: $(BUILD)/book/html/index.html"
	@echo "make book-test       every page of the book in a browser: links, pictures, formulas, width"
	@echo "make package         a Debian package of programs, library, manual pages and book: $(BUILD)/nlmech_*.deb"
	@echo "make python          the Python package: PYTHONPATH=$(BUILD)/python; pip install . installs it"
	@echo "make gallery         redraw the pictures of README and docs/chapters"
	@echo "make pages           docs/chapters: the chapters' pages as Markdown for GitHub"
	@echo "make randomised      all randomised tests, which search for silent failures; tables/RANDOMISED.md; SEEDS=\"1 2\" for more"
	@echo "make oracles         rerun the independent programs of tools/oracles and compare with their stored results"
	@echo "make bench           test the claims about speed and the printed ratios of run times; tables/BENCH.md, RATIOS.md"
	@echo "make build           programs in $(BUILD)/bin"
	@echo "make deps            install all missing Debian packages of packages.txt; each command above installs what it needs"
	@echo "make clean           remove all built and generated files"
	@echo "PRESET=release|dev|asan|repro   NLMECH_CHAPTERS=name,...   NLMECH_PEERS=name,...|none"

deps:
	@scripts/install-packages

.PHONY: needed
needed:
	@scripts/install-packages $(SECTIONS)

# CMake runs again by itself when its files change; a change of selection is passed on at every call.
configure: needed
	@words=$$(cmake --preset $(PRESET) $(SELECTION) 2>&1) || { echo "$$words"; exit 1; }

build: configure
	@cmake --build $(BUILD)

# Figures and verdicts need no test.
programs: configure
	@cmake --build $(BUILD) --target programs

figures: programs
	@$(AT_ONCE) draw

# The second call of make knows the chapters that the configuration selected.
.PHONY: draw
draw: $(DRAWN)
	@echo "figures/<chapter>/*.svg, tables/<chapter>/*.md, results/<chapter>/*.csv are up to date"

# What a chapter computes and draws, once a program: figures, verdicts and the tests of `make test` are all of it. A program
# that was linked anew to the same bytes is not run again.
CHECK = cmake -D CHAPTER=$* -D PROGRAM=$(BUILD)/bin/$* -D OUT=$(BUILD)/check -D SOURCE=$(CURDIR)
.SECONDEXPANSION:
$(OUT)/figures/%/.complete: $(BUILD)/bin/% figures/style.gp figures/curves.xml figures/templates/drawing.gp \
                            $$(wildcard figures/templates/$$*-*.gp tables/*.csv tables/published/*.csv)
	@$(CHECK) -D STEP=measure -P tests/reproduction/check.cmake > /dev/null
	@mkdir -p $(OUT)/figures $(OUT)/tables $(OUT)/results
	@for kind in figures tables results; do [ ! -e $(BUILD)/check/$$kind/$* ] || cp -r $(BUILD)/check/$$kind/$* $(OUT)/$$kind/; done
	@touch $@
	@echo "$*: $$(ls $(OUT)/figures/$*/*.svg | wc -l) figures, $$(ls $(OUT)/tables/$*/*.md | wc -l) tables"

tables: programs
	@$(AT_ONCE) all-numbers

.PHONY: all-numbers
all-numbers: $(CHAPTERS:%=numbers-%)
numbers-%:
	@$(BUILD)/bin/$* run --all --no-plots --quiet --out $(OUT)

chapter-%: programs
	@$(BUILD)/bin/$* check --draw --out $(OUT)

test: build
	@ctest --preset $(PRESET) -j2

# What takes long and rarely fails: all scenes twice, a program built against the installed library, pages broken on purpose.
test-long: build
	@ctest --test-dir $(BUILD) -L '^long$$' -E '^long/(randomised|oracles|Package)' -j2 --output-on-failure

# All random cases, of each of the seeds; the tests of `make test` run a share of the first's.
SEEDS ?= 1
randomised: build
	@rm -rf $(BUILD)/randomised
	@failed=0; for seed in $(SEEDS); do \
	  NLMECH_RANDOMISED_SEED=$$seed ctest --test-dir $(BUILD) -R '^long/randomised/' -j2 --output-on-failure || failed=1; done; \
	scripts/randomised-table $(BUILD)/randomised > tables/RANDOMISED.md.new && mv tables/RANDOMISED.md.new tables/RANDOMISED.md; exit $$failed

# Runs each program of tools/oracles and compares with tables/reference/oracles; then sources with these rows; then the references of the test set
# for boundary values.
oracles: configure
	@cmake --build $(BUILD) --target reference_programs
	@scripts/oracles run && scripts/oracles uses
	@python3 -B tools/bvp_test_set_references.py | diff tables/reference/bvp_test_set.csv - >&2

# All chapters are checked before the command says whether a check failed.
check: figures
	@failed=0; $(AT_ONCE) -k $(CHAPTERS:%=quantities-%) || failed=1; \
	cat $(CHAPTERS:%=$(BUILD)/check/%.values); \
	python3 -B scripts/tables check . $(OUT) $(CHAPTERS) || failed=1; \
	exit $$failed

quantities-%:
	@$(CHECK) -D STEP=measure -P tests/reproduction/check.cmake
	@$(CHECK) -D STEP=quantities -P tests/reproduction/check.cmake

# Claims about speed, measured on an idle machine with AVX2 and, where the processor has it, AVX-512; tables/BENCH.md. Printed ratios of run times;
# tables/RATIOS.md.
bench: configure
	@cmake --build $(BUILD) --target benchmarks
	@failed=0; sets=$$(grep -qw avx512f /proc/cpuinfo && echo avx2 avx512 || echo avx2); \
	for b in $(BUILD)/bin/*_bench; do case $$b in *_ratios_bench) $$b || failed=1; continue;; esac; \
	  for set in $$sets; do NLMECH_INSTRUCTION_SET=$$set $$b || failed=1; done; done; \
	python3 -B scripts/tables bench . || failed=1; exit $$failed

book: programs
	@$(MAKE) --no-print-directory check > /dev/null
	@cmake --build $(BUILD) --target book

# Every page in a headless browser.
book-test: book
	@ctest --test-dir $(BUILD) -L '^book$$' --output-on-failure

# Programs, library and book as a Debian package; `scripts/package try` installs and uses it in a bare root.
package: book
	@scripts/package make $(BUILD)

python: configure
	@cmake --build $(BUILD) --target python

# The pictures of README and docs/chapters, each named <chapter>-<scene>.svg, as their scenes draw them now.
gallery: programs
	@for picture in docs/gallery/*.svg; do \
	  name=$$(basename $$picture .svg); \
	  for c in $(CHAPTERS); do case $$name in $$c-*) \
	    $(BUILD)/bin/$$c run $${name#$$c-} --quiet --out $(BUILD)/gallery && cp $(BUILD)/gallery/figures/$$c/$${name#$$c-}.svg $$picture || exit 1;; \
	  esac; done; done

# The chapters' pages as forges show them: docs/chapters/*.md.
pages: figures
	@python3 -B scripts/book/forge.py write . $(OUT) $(CHAPTERS)

clean:
	@rm -rf $(BUILD) results book
	@find figures tables -mindepth 1 -maxdepth 1 -type d ! -name templates ! -name published ! -name errata ! -name frames ! -name reference -exec rm -rf {} +
