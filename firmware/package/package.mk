# How Pinhole gets into other people's projects. The Makefile includes this file.
#
#   make install PREFIX=/usr/local          programs, man pages, completion; the library with headers, pkg-config, CMake
#   make install-dev                        the library alone, and its sources for CMake projects of another CPU
#   make dist                               build/dist/: a tarball of git's HEAD, and the library for Arduino and ESP-IDF
#   make examples                           firmware/package/examples: the pictures, their README and CRCs
#   make docs                             build/docs/html/: headers, papers, examples and a tutorial as a site, by Doxygen
#   make release URL=https://..             all that is published, with checksums and changes: build/release/
#   make deb                                build/deb/: Debian packages, through debian/
PREFIX ?= /usr/local
LIBDIR ?= lib
URL ?=
HERE := firmware/package
IN = $(DESTDIR)$(PREFIX)
INCLUDES = $(IN)/include/pinhole
LIBRARY = $(IN)/$(LIBDIR)
SOURCES = $(IN)/share/pinhole
RULES = $(IN)/lib/udev/rules.d
UNITS = $(IN)/lib/systemd/system
MAN = $(IN)/share/man/man1
METAINFO = $(IN)/share/metainfo
COMPLETION = $(IN)/share/bash-completion/completions
CORE_ROOMS := $(patsubst firmware/core/%/,%,$(filter-out %/kernels/,$(wildcard firmware/core/*/))) $(patsubst firmware/core/%/,%,$(wildcard $(KERNELS)/*/)) kernels
# What a template's @NAME@ stand for.
FILL = sed -e 's|@PREFIX@|$(PREFIX)|g; s|@LIBDIR@|$(LIBDIR)|g; s|@VERSION@|$(PINHOLE_VERSION)|g'
INSTALL = install -m 644

.PHONY: install install-programs install-dev uninstall dist deb docs release examples

install: install-programs install-dev ## programs, man pages, library and headers, below PREFIX=/usr/local; pkg-config and CMake find it

install-programs: all
	install -d '$(IN)/bin' '$(RULES)' '$(UNITS)' '$(METAINFO)' '$(COMPLETION)' '$(MAN)'
	install -m 755 $(PROGRAMS) '$(IN)/bin'
	$(INSTALL) boards/udev/60-pinhole.rules '$(RULES)'
	$(INSTALL) $(HERE)/org.example.pinhole.metainfo.xml '$(METAINFO)'
	sed 's|/usr/local/|$(PREFIX)/|' boards/systemd/pinhole.service >'$(UNITS)/pinhole.service'
	for p in $(notdir $(PROGRAMS)); do $(INSTALL) $(HERE)/completion.bash '$(COMPLETION)'/$$p || exit 1; done
	for p in $(PROGRAMS); do $(HERE)/man.sh $$p '$(MAN)'/$$(basename $$p).1 || exit 1; done

install-dev: $(B)/libpinhole.a ## the library alone: headers, libpinhole.a, its sources for CMake projects of another CPU
	install -d '$(INCLUDES)' '$(LIBRARY)/pkgconfig' '$(LIBRARY)/cmake/Pinhole' '$(SOURCES)/package' $(CORE_ROOMS:%='$(SOURCES)/core/%')
	$(INSTALL) firmware/core/*.h firmware/core/fx/*.hpp firmware/core/kernels/portable/fx_cpu.h '$(INCLUDES)'
	$(INSTALL) $(B)/libpinhole.a '$(LIBRARY)'
	$(FILL) $(HERE)/pinhole.pc.in >'$(LIBRARY)/pkgconfig/pinhole.pc'
	$(FILL) $(HERE)/PinholeConfig.cmake.in >'$(LIBRARY)/cmake/Pinhole/PinholeConfig.cmake'
	$(FILL) $(HERE)/PinholeConfigVersion.cmake.in >'$(LIBRARY)/cmake/Pinhole/PinholeConfigVersion.cmake'
	$(INSTALL) $(HERE)/pinhole.cmake '$(SOURCES)/package'
	$(INSTALL) firmware/core/*.h firmware/core/fx/*.hpp '$(SOURCES)/core'
	for room in $(CORE_ROOMS); do find firmware/core/$$room -maxdepth 1 -type f -exec $(INSTALL) {} '$(SOURCES)/core'/$$room ';' || exit 1; done

uninstall: ## takes away what install brought
	rm -f $(PROGRAMS:$(B)/%='$(IN)/bin/%') '$(RULES)/60-pinhole.rules' '$(UNITS)/pinhole.service' '$(METAINFO)/org.example.pinhole.metainfo.xml'
	rm -f $(PROGRAMS:$(B)/%='$(MAN)/%.1') $(PROGRAMS:$(B)/%='$(COMPLETION)/%')
	rm -rf '$(INCLUDES)' '$(LIBRARY)/cmake/Pinhole' '$(SOURCES)'
	rm -f '$(LIBRARY)/libpinhole.a' '$(LIBRARY)/pkgconfig/pinhole.pc'

dist: ## a tarball of git's HEAD, an Arduino and PlatformIO library, an ESP-IDF component: build/dist/; PROFILE=small: an Arduino library for small chips
	$(Q)B='$(B)' PROFILE='$(PROFILE)' VERSION='$(PINHOLE_VERSION)' URL='$(URL)' $(HERE)/dist.sh

deb: ## Debian packages pinhole and libpinhole-dev of git's HEAD, checked by lintian: build/deb/
	$(Q)B='$(B)' VERSION='$(PINHOLE_VERSION)' $(HERE)/deb.sh

release: ## URL=https://..: UF2 files, page, docs, packages, with checksums and changes, of a clean tree: build/release; uploads nothing
	$(Q)B='$(B)' VERSION='$(PINHOLE_VERSION)' URL='$(URL)' $(HERE)/release.sh

docs: ## the public headers, papers, examples and a tutorial as a site: build/docs/html (Doxygen)
	$(Q)B='$(B)' VERSION='$(PINHOLE_VERSION)' $(HERE)/docs/docs.sh

examples: all ## builds and runs the examples; writes their pictures, README and CRCs again
	$(Q)B='$(B)' CC='$(CC)' $(HERE)/examples.sh
