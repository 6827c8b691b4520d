<?xml version="1.0"?>
<!-- SPDX-FileCopyrightText: The Far-LoD authors -->
<!-- SPDX-License-Identifier: Apache-2.0 -->
<CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml" xmlns:xlink="http://www.w3.org/1999/xlink" xmlns:bldg="http://www.opengis.net/citygml/building/2.0">
<cityObjectMember><bldg:Building gml:id="a"><bldg:lod1MultiSurface><gml:MultiSurface srsName="EPSG:25832"><gml:surfaceMember><gml:Polygon gml:id="p"><gml:exterior><gml:LinearRing><gml:posList>0 0 1 9 0 1 9 9 1 0 0 1</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod1MultiSurface></bldg:Building></cityObjectMember>
<cityObjectMember><bldg:Building gml:id="a"><bldg:lod1MultiSurface xlink:href="#p"/><bldg:lod1MultiSurface><gml:MultiSurface><gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>0 0 2 9 0 2 9 9 2</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod1MultiSurface></bldg:Building></cityObjectMember>
<cityObjectMember><Thing/></cityObjectMember>
</CityModel>
