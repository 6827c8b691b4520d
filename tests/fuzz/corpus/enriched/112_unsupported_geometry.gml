<?xml version="1.0" encoding="UTF-8"?>
<!-- SPDX-FileCopyrightText: The Far-LoD authors -->
<!-- SPDX-License-Identifier: Apache-2.0 -->
<CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml"
           xmlns:bldg="http://www.opengis.net/citygml/building/2.0" xmlns:xlink="http://www.w3.org/1999/xlink">
  <gml:boundedBy><gml:Envelope srsName="EPSG:25832" srsDimension="3"/></gml:boundedBy>
  <cityObjectMember><bldg:Building gml:id="house"><bldg:lod2MultiSurface><gml:MultiSurface>
    <gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>500000 5400000 100 500000 5400008 100 500010 5400008 100 500010 5400000 100 500000 5400000 100</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>
    <gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>500000 5400000 106 500010 5400000 106 500010 5400008 106 500000 5400008 106 500000 5400000 106</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>
    <gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>500000 5400000 100 500010 5400000 100 500010 5400000 106 500000 5400000 106 500000 5400000 100</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>
    <gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>500010 5400000 100 500010 5400008 100 500010 5400008 106 500010 5400000 106 500010 5400000 100</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>
    <gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>500010 5400008 100 500000 5400008 100 500000 5400008 106 500010 5400008 106 500010 5400008 100</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>
    <gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>500000 5400008 100 500000 5400000 100 500000 5400000 106 500000 5400008 106 500000 5400008 100</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>
    <gml:surfaceMember><gml:Polygon gml:id="arch"><gml:exterior><gml:Ring><gml:curveMember><gml:Curve><gml:segments><gml:Arc><gml:posList>500000 5400000 106 500010 5400000 106 500010 5400008 106</gml:posList></gml:Arc></gml:segments></gml:Curve></gml:curveMember></gml:Ring></gml:exterior></gml:Polygon></gml:surfaceMember>
  </gml:MultiSurface></bldg:lod2MultiSurface></bldg:Building></cityObjectMember>
</CityModel>
